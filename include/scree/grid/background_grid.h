#pragma once

#include <scree/bodies/body.h>
#include <scree/parameters/section.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/distributed/tria.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace scree
{
/** How the background grid is refined. */
enum class GridRefinement
{
  /** every cell at the finest level */
  uniform,
  /** finest where bodies may touch, coarser with the distance from there */
  contact
};

/**
 * The levels that the cells of a new grid shall have, from the active cells of an older one along
 * the Morton curve: the same on all processes.
 */
struct WantedLevels
{
  unsigned int                                        finest_level   = 0; //!< the largest of them
  unsigned int                                        coarsest_level = 0;
  std::vector<std::pair<std::uint64_t, unsigned int>> cells; //!< key at finest_level, level
};

/** Parameters of section Grid. */
template <int dim>
struct GridParameters
{
  dealii::Point<dim>        lower;
  dealii::Point<dim>        upper;
  std::vector<unsigned int> cells; //!< per direction, at level 0
  unsigned int              finest_level    = 4;
  unsigned int              coarsest_level  = 0;
  GridRefinement            refinement      = GridRefinement::uniform;
  double                    band            = 3.;  //!< finest cells around contact, in h
  double                    grading         = 0.5; //!< growth of the cell size per distance
  std::string               cell_size_limit = "";  //!< expression of position [L]
  /** Instead of `refinement`: levels from a run before (no entry). */
  std::shared_ptr<const WantedLevels> wanted_levels;

  /** These with the levels of a run before. */
  GridParameters with(const std::shared_ptr<const WantedLevels> &levels) const;

  void declare(ParameterSection &section);

  /** Edge of a cell at `level` [L]. */
  double cell_size(const unsigned int level) const
  {
    return (upper[0] - lower[0]) / cells[0] / (1u << level);
  }
};

/** One active cell, owned or ghost, of this process: an axis-aligned cube. */
template <int dim>
struct GridCell
{
  dealii::Point<dim>                                        lower; //!< lower corner [L]
  double                                                    size;  //!< edge [L]
  std::uint64_t                                             key;   //!< Morton key of the corner
  typename dealii::Triangulation<dim>::active_cell_iterator iterator;

  dealii::Point<dim> centre() const
  {
    dealii::Point<dim> result = lower;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] += 0.5 * size;
    return result;
  }
};

/**
 * The p4est background grid: a box of cubes, 2:1 balanced, with a flat list of this process's cells
 * and a replicated map of all active cells, sorted along the Morton curve, that finds the cell and
 * the process of any point (theory.md section 5).
 */
template <int dim>
class BackgroundGrid
{
public:
  BackgroundGrid(const GridParameters<dim> &parameters, const MPI_Comm communicator);

  /**
   * Refines: a cell at distance m from where two bodies of `pairs` may touch keeps the size
   * h + grading * max(0, m - band h), with m = max(phi_a, phi_b); the expression of position limits
   * it further. Uniform: all cells to the finest level. With wanted levels: these, whatever the
   * bodies; more where the balance of the grid asks for it. Then the cells are shared among the
   * processes by the work of the bodies in them.
   */
  void refine(const std::vector<Body<dim>>                             &bodies,
              const std::vector<std::pair<unsigned int, unsigned int>> &pairs);

  /**
   * The description of a grid on which the cells of this one have the given levels, or are finer;
   * collective.
   * @param levels of the owned cells, not below their own
   */
  WantedLevels wanted_levels(const std::vector<unsigned int> &levels) const;

  /** Owned cells first, then ghosts. */
  const std::vector<GridCell<dim>> &cells() const
  {
    return local_cells;
  }

  unsigned int n_owned_cells() const
  {
    return n_owned;
  }

  /** The active cell that contains a point, anywhere in the box. */
  struct Location
  {
    unsigned int rank;       //!< the process that owns the cell
    int          local_cell; //!< its index in cells(), -1 if neither owned nor ghost here
  };

  /** Where `point` lies; points outside the box count as the nearest inside. */
  Location locate(const dealii::Point<dim> &point) const;

  /** Index in cells() of an active cell iterator of this process. */
  int local_index(const typename dealii::CellAccessor<dim> &cell) const
  {
    return local_of_active[cell.active_cell_index()];
  }

  /** Bodies that are closer to each other than this refine the grid between them [L]. */
  double reach_of_refinement() const;

  /** Edge of the finest cells [L]. */
  double finest_size() const
  {
    return parameters.cell_size(parameters.finest_level);
  }

  const dealii::parallel::distributed::Triangulation<dim> &triangulation() const
  {
    return tria;
  }

  const GridParameters<dim> &grid_parameters() const
  {
    return parameters;
  }

  dealii::BoundingBox<dim> box() const
  {
    return dealii::BoundingBox<dim>({parameters.lower, parameters.upper});
  }

  MPI_Comm communicator() const
  {
    return tria.get_communicator();
  }

private:
  void list_cells();
  void refine_by(const WantedLevels &wanted);
  void refine_by_contact(const std::vector<Body<dim>>                             &bodies,
                         const std::vector<std::pair<unsigned int, unsigned int>> &pairs);
  /** A cell of this edge is too large where its centre is nearer to a place of contact [L]. */
  double refinement_distance(const double size) const;
  /** Divides the cells among the processes by the bodies they carry. */
  void          share(const std::vector<Body<dim>> &bodies);
  std::uint64_t key_of(const dealii::Point<dim> &point) const;

  GridParameters<dim>                               parameters;
  dealii::parallel::distributed::Triangulation<dim> tria;
  std::vector<GridCell<dim>>                        local_cells;
  std::vector<int>                                  local_of_active;
  unsigned int                                      n_owned = 0;

  /** All active cells of all processes, sorted by key. */
  struct MapEntry
  {
    std::uint64_t key;
    unsigned int  rank;
    int           local_cell;
  };
  std::vector<MapEntry> map;
};
} // namespace scree
