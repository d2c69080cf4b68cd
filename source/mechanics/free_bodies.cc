#include <scree/mechanics/free_bodies.h>

namespace scree
{
template <int dim>
FreeBodies<dim>::FreeBodies(const Fields<dim> &fields, const std::vector<Body<dim>> &bodies,
                            const StrongSupports<dim> &supports,
                            const BoundaryTerms<dim>  &boundary_terms,
                            const ContactPoints<dim>  &contact)
    : bodies(bodies)
    , supports(supports)
    , boundary_terms(boundary_terms)
    , contact(contact)
    , communicator(fields.grid.communicator())
{
  for (unsigned int b = 0; b < bodies.size(); ++b)
    {
      const RigidMotions<dim>    motions(bodies[b]);
      dealii::FullMatrix<double> held   = resistance_of_supports(b, motions);
      const unsigned int         n_free = motions.n_free(held, communicator);
      if (n_free > 0)
        free_motions.push_back({b, n_free});
    }
}

template <int dim>
dealii::FullMatrix<double>
FreeBodies<dim>::resistance_of_supports(const unsigned int       body,
                                        const RigidMotions<dim> &motions) const
{
  dealii::FullMatrix<double> held = motions.no_resistance();
  if (bodies[body].is_rigid())
    for (unsigned int m = 0; m < motions.n_motions; ++m)
      if (!bodies[body].rigid->is_free(m))
        motions.add_motion_resistance(m, held);
  for (const auto &unknown : supports.unknowns())
    if (supports.conditions()[unknown.support].first == body)
      motions.add_resistance(unknown.position, unknown.component, 1., held);
  for (const auto &region : boundary_terms.regions())
    {
      const ConditionType type = region.condition->parameters.type;
      if (region.body != body || type == ConditionType::traction || type == ConditionType::pressure)
        continue;
      for (const auto &point : region.points)
        for (const unsigned int component : region.condition->components)
          {
            if (component < dim)
              motions.add_resistance(point.position, component, 1., held);
            else
              motions.add_motion_resistance(motions.n_motions - 1, held);
          }
    }
  return held;
}

template <int dim>
std::vector<unsigned int>
FreeBodies<dim>::not_held() const
{
  std::vector<unsigned int> result;
  for (const FreeMotion &free : free_motions)
    {
      const RigidMotions<dim> motions(bodies[free.body]);
      auto                    held = resistance_of_supports(free.body, motions);
      for (unsigned int i = 0; i < contact.points().size(); ++i)
        {
          const auto &point = contact.points()[i];
          const auto &pair  = contact.pairs()[point.pair];
          if ((pair.a != free.body && pair.b != free.body) || contact.responses()[i].pressure == 0.)
            continue;
          motions.add_resistance(point.position, point.normal, 1., held);
          if (contact.responses()[i].status == ContactStatus::stick)
            for (unsigned int d = 0; d < dim; ++d)
              motions.add_resistance(point.position, d, 1., held);
        }
      if (motions.n_free(held, communicator) > 0)
        result.push_back(free.body);
    }
  return result;
}

template class FreeBodies<2>;
template class FreeBodies<3>;
} // namespace scree
