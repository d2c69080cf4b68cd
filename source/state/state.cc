#include <scree/state/state.h>

namespace scree
{
template <int dim>
State<dim>
initial_state(const Fields<dim> &fields, const ContactPoints<dim> &contact)
{
  State<dim> state;
  state.displacement.reinit(fields.owned(), fields.grid.communicator());
  state.contact = contact.initial_history();
  return state;
}

template State<2> initial_state(const Fields<2> &, const ContactPoints<2> &);
template State<3> initial_state(const Fields<3> &, const ContactPoints<3> &);
} // namespace scree
