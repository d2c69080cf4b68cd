#pragma once

#include <scree/output/assembly.h>

#include <array>
#include <string>
#include <vector>

namespace scree
{
/**
 * The closed contacts of a step as lines from the centroid of a body to the place of the contact
 * and on to the centroid of the other one, at a wall only to the place: what a branch_vector()
 * spans. Points are where those of grain_states() are.
 */
template <int dim>
class ForceChains
{
public:
  /** No lines. */
  ForceChains() = default;

  ForceChains(const std::vector<Body<dim>> &bodies, const std::vector<ContactPair> &pairs,
              const std::vector<ContactSummary<dim>> &summaries,
              const std::vector<GrainState<dim>>     &grains);

  /**
   * Writes DIR/chains_NNNN.vtp with normal_force, tangential_force, the force on b as a vector and
   * the number of the pair on each line; returns the name for a PVD record, empty if it could not.
   * For one process.
   */
  std::string write(const std::string &directory, const unsigned int number,
                    const double time) const;

private:
  /** Half of a contact, or that at a wall. */
  struct Line
  {
    std::array<dealii::Point<dim>, 2> ends;
    unsigned int                      pair;
    double                            normal_force, tangential_force;
    dealii::Tensor<1, dim>            force;
  };
  std::vector<Line> lines;
};
} // namespace scree
