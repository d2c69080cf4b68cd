#pragma once

#include <scree/contact/level_set_surface.h>
#include <scree/mechanics/cut_cell_gauss.h>
#include <scree/mechanics/incremental_kinematics.h>
#include <scree/points/seeding.h>

#include <functional>
#include <random>

#include "equilibrium_model.h"

namespace scree
{
/** x - X as a function of the present position x. */
template <int dim>
using Displacement = std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &)>;

/** Bodies at the start of a step, which material points brought there by a displacement. */
template <int dim>
struct StartedStep
{
  using Vector = dealii::TrilinosWrappers::MPI::Vector;

  StartedStep(const std::string &text, const std::string &law,
              const Displacement<dim> &displacement, const double plastic_strain = 0.)
      : input(text)
      , cut(input.bodies)
      , quadrature(*cut.space, *cut.level_set_nodes, cut.bodies)
      , points(moved(law, displacement, plastic_strain))
      , made_start(std::make_unique<const StepStart<dim>>(*cut.space, quadrature, cut.bodies,
                                                          points, parameters))
      , start(*made_start)
      , small_cuts(make_small_cut_treatment(*cut.space, input.bodies.discretization.ghost_penalty))
      , kinematics(
          *cut.space, quadrature, cut.bodies, *small_cuts, std::move(made_start),
          std::make_unique<const CutCellGauss<dim>>(*cut.space, quadrature, cut.bodies, start), 0.)
      , bulk(kinematics.bulk())
      , boundary_terms(*cut.space, *cut.level_set_nodes, quadrature, cut.bodies, kinematics)
      , contact(cut.bodies, contact_pairs(),
                level_set_surface(*cut.space, *cut.level_set_nodes, cut.bodies, contact_pairs(),
                                  input.contact.shift * cut.grid.finest_size()))
      , equilibrium(*cut.space, cut.bodies, kinematics, boundary_terms, contact)
  {
  }

  MaterialPoints<dim> moved(const std::string &law, const Displacement<dim> &displacement,
                            const double plastic_strain)
  {
    MaterialParameters material;
    material.law     = law;
    material.young   = 1000.;
    material.poisson = 0.3;
    if (is_plastic(law))
      {
        material.yield_stress      = 20.;
        material.hardening_modulus = 50.;
      }
    const std::shared_ptr<const IncrementLaw<dim>> shared = make_increment_law<dim>(material);
    for (auto &body : cut.bodies)
      if (!body.is_rigid())
        body.law = shared;
    const std::vector<double> density(cut.bodies.size(), 1.);
    const unsigned int        n_internal
      = StepStart<dim>::needs_internal(cut.bodies) ? StepStart<dim>::n_internal : 0;
    MaterialPoints<dim> result
      = PointSeeding<dim>(*cut.space, *cut.level_set_nodes, cut.bodies, quadrature, density)
          .on_sub_grid(cut.space->basis.degree + 1, n_internal);
    for (std::size_t p = 0; p < result.size(); ++p)
      {
        result.reference_position[p] = result.position[p] - displacement(result.position[p]);
        if (n_internal > 0)
          result.internal[p * n_internal + 6] = plastic_strain;
      }
    return result;
  }

  std::vector<ContactPair> contact_pairs() const
  {
    std::vector<ContactPair> pairs;
    for (const auto &[a, b] : cut.pairs)
      pairs.push_back({a, b, "pair", input.contact.law_of("a", "b")});
    return pairs;
  }

  /** Random increments of the given size at the nodes. */
  Vector random(const double size, const unsigned int seed) const
  {
    Vector                                 u(cut.space->owned(), MPI_COMM_WORLD);
    std::mt19937                           engine(seed);
    std::uniform_real_distribution<double> number(-size, size);
    for (const DofIndex index : cut.space->owned())
      u(index) = cut.space->hanging_constraints().is_constrained(index) ? 0. : number(engine);
    u.compress(dealii::VectorOperation::insert);
    equilibrium.strong_supports().set_zero(u);
    return u;
  }

  EquilibriumInput<dim>                         input;
  CutBodies<dim>                                cut;
  MovingGeometryParameters                      parameters;
  CutQuadrature<dim>                            quadrature;
  MaterialPoints<dim>                           points;
  std::unique_ptr<const StepStart<dim>>         made_start; //!< now of the kinematics
  const StepStart<dim>                         &start;
  std::unique_ptr<const SmallCutTreatment<dim>> small_cuts;
  IncrementalKinematics<dim>                    kinematics;
  const Bulk<dim>                              &bulk;
  BoundaryTerms<dim>                            boundary_terms;
  ContactPoints<dim>                            contact;
  Equilibrium<dim>                              equilibrium;
};
} // namespace scree
