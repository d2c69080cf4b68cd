#include <scree/state/gather.h>
#include <scree/state/placed_values.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace scree
{
template <int dim>
PlacedValues<dim>::PlacedValues(const unsigned int n_values, const dealii::Point<dim> &origin,
                                const double resolution)
    : n_values(n_values)
    , origin(origin)
    , resolution(resolution)
{
}

template <int dim>
typename PlacedValues<dim>::Place
PlacedValues<dim>::place(const unsigned int number, const dealii::Point<dim> &x) const
{
  Place result;
  result[0] = number;
  for (unsigned int d = 0; d < dim; ++d)
    result[1 + d] = std::llround((x[d] - origin[d]) / resolution);
  return result;
}

template <int dim>
void
PlacedValues<dim>::add(const unsigned int number, const dealii::Point<dim> &x,
                       const std::vector<double> &row)
{
  AssertDimension(row.size(), n_values);
  places.push_back(place(number, x));
  values.insert(values.end(), row.begin(), row.end());
}

template <int dim>
void
PlacedValues<dim>::gather(const MPI_Comm communicator)
{
  const std::vector<Place>  all_places = gather_joined(places, communicator);
  const std::vector<double> all_values = gather_joined(values, communicator);
  std::vector<std::size_t>  order(all_places.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](const std::size_t i, const std::size_t j) {
    return all_places[i] < all_places[j];
  });
  places.clear();
  values.clear();
  for (const std::size_t i : order)
    if (places.empty() || places.back() != all_places[i])
      {
        places.push_back(all_places[i]);
        values.insert(values.end(), all_values.begin() + i * n_values,
                      all_values.begin() + (i + 1) * n_values);
      }
}

template <int dim>
const double *
PlacedValues<dim>::find(const unsigned int number, const dealii::Point<dim> &x) const
{
  const Place wanted = place(number, x);
  const auto  found  = std::lower_bound(places.begin(), places.end(), wanted);
  if (found == places.end() || *found != wanted)
    return nullptr;
  return &values[(found - places.begin()) * n_values];
}

template class PlacedValues<2>;
template class PlacedValues<3>;
} // namespace scree
