#include <scree/level_set/extended_increment.h>

#include <algorithm>
#include <cmath>

namespace scree
{
template <int dim>
ExtendedIncrement<dim>::ExtendedIncrement(const Lattice<dim> &lattice, NodalVectors<dim> &&values)
    : first(lattice.node(lattice.lower()))
    , spacing(lattice.spacing())
    , n_nodes(lattice.n_nodes())
    , nodal(std::move(values))
{
}

template <int dim>
bool
ExtendedIncrement<dim>::is_whole(const double limit) const
{
  if (is_empty())
    return std::all_of(nodal.begin(), nodal.end(), [](const auto &v) { return v.empty(); });
  const auto is_sound
    = [&](const double x) { return std::abs(x) < limit; }; // not what is no number
  return spacing > 0. && std::all_of(first.begin_raw(), first.end_raw(), is_sound)
         && std::all_of(nodal.begin(), nodal.end(), [&](const auto &v) {
              return is_number_of_nodes<dim>(v.size(), n_nodes, 2)
                     && std::all_of(v.begin(), v.end(), is_sound);
            });
}

template <int dim>
dealii::Tensor<1, dim>
ExtendedIncrement<dim>::operator()(const dealii::Point<dim> &x) const
{
  std::size_t                  node = 0, step = 1;
  std::array<std::size_t, dim> stride;
  std::array<double, dim>      t;
  for (unsigned int d = 0; d < dim; ++d)
    {
      const double place = (x[d] - first[d]) / spacing;
      // In this order what is no number has a place, too.
      const double s    = place > 0. ? std::min(place, n_nodes[d] - 1.) : 0.;
      const int    base = std::min(static_cast<int>(s), n_nodes[d] - 2);
      t[d]              = s - base;
      stride[d]         = step;
      node += base * step;
      step *= n_nodes[d];
    }
  dealii::Tensor<1, dim> result;
  for (unsigned int corner = 0; corner < (1u << dim); ++corner)
    {
      double      weight = 1.;
      std::size_t at     = node;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const bool above = corner >> d & 1u;
          weight *= above ? t[d] : 1. - t[d];
          at += above ? stride[d] : 0;
        }
      for (unsigned int d = 0; d < dim; ++d)
        result[d] += weight * nodal[d][at];
    }
  return result;
}

template class ExtendedIncrement<2>;
template class ExtendedIncrement<3>;
} // namespace scree
