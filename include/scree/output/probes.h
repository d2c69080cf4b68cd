#pragma once

#include <scree/mechanics/equilibrium.h>
#include <scree/parameters/section.h>

#include <string>
#include <utility>
#include <vector>

namespace scree
{
/** A point, or points along a line, of a body where fields are tabulated. */
template <int dim>
struct ProbeParameters
{
  std::string        name;
  std::string        body;
  dealii::Point<dim> start;                       //!< the point, or the first one of a line [L]
  dealii::Point<dim> end;                         //!< of a line [L]
  unsigned int       n_points            = 1;     //!< 1: a point
  bool               with_plastic_strain = false; //!< whether the body has a yield stress

  void declare(ParameterSection &section);
};

/** The number of the body of a probe. */
template <int dim>
unsigned int body_of_probe(const ProbeParameters<dim> &probe, const std::vector<Body<dim>> &bodies);

/** Columns of the samples of a probe: position, displacement, stress, von Mises, plastic strain. */
template <int dim>
std::vector<std::string> sample_columns(const ProbeParameters<dim> &probe);

/**
 * Samples of a probe, at places that do not move with the body; `u` ghosted. Same rows on all
 * processes; NaN where the body has no cell at a point.
 * @throws UserError instead of NaN if it must have one
 */
template <int dim>
std::vector<std::vector<double>> sample(const ProbeParameters<dim> &probe, const unsigned int body,
                                        const DisplacementSpace<dim> &space, const Bulk<dim> &bulk,
                                        const dealii::TrilinosWrappers::MPI::Vector &u,
                                        const bool                                   must_exist);
} // namespace scree
