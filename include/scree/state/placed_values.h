#pragma once

#include <deal.II/base/point.h>

#include <array>
#include <boost/serialization/array.hpp>
#include <boost/serialization/vector.hpp>
#include <cstdint>
#include <mpi.h>
#include <vector>

namespace scree
{
/**
 * Rows of numbers at places, each of something with a number (a body, a pair): nodal values or
 * histories in an order that does not depend on the processes that have them. Places closer than
 * the resolution are the same.
 */
template <int dim>
class PlacedValues
{
public:
  PlacedValues() = default;

  /**
   * @param n_values   numbers per place
   * @param origin     of the coordinates [L]
   * @param resolution [L], far below all distances and far above round-off in coordinates
   */
  PlacedValues(const unsigned int n_values, const dealii::Point<dim> &origin,
               const double resolution);

  /** Adds a row of n_values numbers. */
  void add(const unsigned int number, const dealii::Point<dim> &x,
           const std::vector<double> &values);

  /** Collects the rows of all processes, sorted, each place once, on the first one. Collective. */
  void gather(const MPI_Comm communicator);

  /** After gather(): the row of a place, nullptr if there is none. */
  const double *find(const unsigned int number, const dealii::Point<dim> &x) const;

  std::size_t size() const
  {
    return places.size();
  }

  /** Numbers per place. */
  unsigned int row_size() const
  {
    return n_values;
  }

  /** Whether each place has a row of `n` numbers: of what comes from a file it need not have. */
  bool is_whole(const unsigned int n) const
  {
    return n_values == n && values.size() == places.size() * n_values;
  }

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &n_values &origin &resolution &places &values;
  }

private:
  /** Number, then coordinates over the resolution, rounded. */
  using Place = std::array<std::int64_t, dim + 1>;

  Place place(const unsigned int number, const dealii::Point<dim> &x) const;

  unsigned int        n_values = 0;
  dealii::Point<dim>  origin;
  double              resolution = 1.;
  std::vector<Place>  places;
  std::vector<double> values; //!< n_values per place
};
} // namespace scree
