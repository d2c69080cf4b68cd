#include <scree/base/exceptions.h>
#include <scree/geometry/label_image.h>
#include <scree/geometry/label_readers.h>

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>

namespace scree
{
template <int dim>
LabelImage<dim>::LabelImage(const Pixel &n_pixels, std::vector<Label> labels)
    : n(n_pixels)
    , labels(std::move(labels))
{
  AssertDimension(this->labels.size(),
                  std::accumulate(n.begin(), n.end(), std::size_t(1), std::multiplies<>()));
}

template <int dim>
LabelImage<dim>
LabelImage<dim>::read(const std::string &bytes, const std::string &name)
{
  LabelArray array = read_labels(bytes, name);
  require(array.n_pixels.size() == dim, name,
          "the image has " + std::to_string(array.n_pixels.size()) + " dimensions",
          "set Dimension = " + std::to_string(array.n_pixels.size()) + ", or name another file");
  if (dim == 2 && array.rows_from_above)
    {
      const std::size_t width = array.n_pixels[0], height = array.n_pixels[1];
      for (std::size_t j = 0; j < height / 2; ++j)
        std::swap_ranges(array.labels.begin() + j * width, array.labels.begin() + (j + 1) * width,
                         array.labels.begin() + (height - 1 - j) * width);
    }
  Pixel n = {};
  std::copy(array.n_pixels.begin(), array.n_pixels.end(), n.begin());
  LabelImage image(n, std::move(array.labels));
  image.pixel_size = array.pixel_size;
  return image;
}

namespace
{
/** Calls `visit` for the first pixel of each row from `lower` to `upper`, rows and pages upwards.
 */
template <int dim, typename Visit>
void
for_each_row(const std::array<int, dim> &lower, const std::array<int, dim> &upper,
             const Visit &visit)
{
  std::array<int, dim> pixel = lower;
  while (pixel[dim - 1] <= upper[dim - 1])
    {
      visit(pixel);
      int d = 1;
      while (++pixel[d] > upper[d] && d + 1 < dim)
        {
          pixel[d] = lower[d];
          ++d;
        }
    }
}

/** Sets of runs of pixels that are joined, by union-find. */
class JoinedRuns
{
public:
  std::size_t add()
  {
    parent.push_back(parent.size());
    return parent.back();
  }

  std::size_t root(std::size_t run)
  {
    while (parent[run] != run)
      run = parent[run] = parent[parent[run]];
    return run;
  }

  void join(const std::size_t a, const std::size_t b)
  {
    const std::size_t first = root(a), second = root(b);
    parent[std::max(first, second)] = std::min(first, second);
  }

private:
  std::vector<std::size_t> parent;
};

/** Pixels of equal label side by side in a row. */
template <int dim>
struct Run
{
  std::uint32_t        label;
  std::array<int, dim> first;
  int                  last;
};

/** The runs of all labels but 0. */
template <int dim>
struct RowsOfRuns
{
  std::vector<Run<dim>>    runs;
  std::vector<std::size_t> first_of_row; // and one more
};

template <int dim>
RowsOfRuns<dim>
runs_of(const LabelImage<dim> &image)
{
  RowsOfRuns<dim> result;
  for_each_row<dim>({}, image.last_pixel(), [&](std::array<int, dim> pixel) {
    result.first_of_row.push_back(result.runs.size());
    std::uint32_t before = 0;
    for (; pixel[0] < image.n_pixels()[0]; ++pixel[0])
      {
        const std::uint32_t label = image(pixel);
        if (label != 0 && label == before)
          result.runs.back().last = pixel[0];
        else if (label != 0)
          result.runs.push_back({label, pixel, pixel[0]});
        before = label;
      }
  });
  result.first_of_row.push_back(result.runs.size());
  return result;
}

/** Joins the runs of two rows side by side that have a label and a column in common. */
template <int dim>
void
join_rows(const RowsOfRuns<dim> &rows, const std::size_t row, const std::size_t other,
          JoinedRuns &joined)
{
  std::size_t a = rows.first_of_row[row], b = rows.first_of_row[other];
  while (a < rows.first_of_row[row + 1] && b < rows.first_of_row[other + 1])
    {
      const Run<dim> &of_row = rows.runs[a], &of_other = rows.runs[b];
      if (of_row.first[0] <= of_other.last && of_other.first[0] <= of_row.last
          && of_row.label == of_other.label)
        joined.join(a, b);
      of_row.last < of_other.last ? ++a : ++b;
    }
}

template <int dim>
void
add_run(const Run<dim> &run, LabelPiece<dim> &piece)
{
  if (piece.n_pixels == 0)
    piece = {run.label, run.first, run.first, run.first, 0};
  for (unsigned int d = 0; d < dim; ++d)
    {
      piece.lower[d] = std::min(piece.lower[d], run.first[d]);
      piece.upper[d] = std::max(piece.upper[d], d == 0 ? run.last : run.first[d]);
    }
  piece.n_pixels += run.last - run.first[0] + 1;
}

/** Calls `visit` for the neighbours of a pixel across its sides that are in the image. */
template <int dim, typename Visit>
void
for_each_neighbour(const LabelImage<dim> &image, typename LabelImage<dim>::Pixel pixel,
                   const Visit &visit)
{
  for (unsigned int d = 0; d < dim; ++d)
    {
      for (const int step : {-1, 2})
        {
          pixel[d] += step;
          if (image.contains(pixel))
            visit(pixel);
        }
      --pixel[d];
    }
}
} // namespace

template <int dim>
LabelImage<dim>
LabelImage<dim>::part(const Pixel &lower, const Pixel &upper) const
{
  Pixel n_part;
  for (unsigned int d = 0; d < dim; ++d)
    n_part[d] = upper[d] - lower[d] + 1;
  std::vector<Label> of_part;
  for_each_row<dim>(lower, upper, [&](const Pixel &first) {
    const auto begin = labels.begin() + offset(first);
    of_part.insert(of_part.end(), begin, begin + n_part[0]);
  });
  LabelImage result(n_part, std::move(of_part));
  result.pixel_size = pixel_size;
  return result;
}

template <int dim>
std::vector<LabelPiece<dim>>
pieces_of(const LabelImage<dim> &image)
{
  const RowsOfRuns<dim> rows = runs_of(image);
  JoinedRuns            joined;
  for (std::size_t r = 0; r < rows.runs.size(); ++r)
    joined.add();
  const std::size_t n_rows = rows.first_of_row.size() - 1, n_of_page = image.n_pixels()[1];
  for (std::size_t row = 0; row < n_rows; ++row)
    {
      if (row % n_of_page > 0)
        join_rows(rows, row, row - 1, joined);
      if (row >= n_of_page)
        join_rows(rows, row, row - n_of_page, joined);
    }
  constexpr auto               none = static_cast<std::size_t>(-1);
  std::vector<std::size_t>     piece_of(rows.runs.size(), none);
  std::vector<LabelPiece<dim>> pieces;
  for (std::size_t r = 0; r < rows.runs.size(); ++r)
    {
      std::size_t &piece = piece_of[joined.root(r)];
      if (piece == none)
        {
          piece = pieces.size();
          pieces.push_back({});
        }
      add_run(rows.runs[r], pieces[piece]);
    }
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const LabelPiece<dim> &a, const LabelPiece<dim> &b) {
                     return a.label != b.label ? a.label < b.label : a.n_pixels > b.n_pixels;
                   });
  return pieces;
}

template <int dim>
std::vector<bool>
pixels_of(const LabelImage<dim> &image, const LabelPiece<dim> &piece)
{
  using Pixel                    = typename LabelImage<dim>::Pixel;
  std::size_t                  n = 1;
  std::array<std::size_t, dim> stride;
  for (unsigned int d = 0; d < dim; ++d)
    {
      stride[d] = n;
      n *= piece.upper[d] - piece.lower[d] + 1;
    }
  std::vector<bool>  result(n);
  std::vector<Pixel> todo;
  const auto         visit = [&](const Pixel &pixel) {
    std::size_t place = 0;
    for (unsigned int d = 0; d < dim; ++d)
      if (pixel[d] < piece.lower[d] || pixel[d] > piece.upper[d])
        return;
      else
        place += (pixel[d] - piece.lower[d]) * stride[d];
    if (result[place] || image(pixel) != piece.label)
      return;
    result[place] = true;
    todo.push_back(pixel);
  };
  visit(piece.first);
  while (!todo.empty())
    {
      const Pixel pixel = todo.back();
      todo.pop_back();
      for_each_neighbour(image, pixel, visit);
    }
  return result;
}

template <int dim>
std::vector<typename LabelImage<dim>::Pixel>
list_of_pixels(const LabelImage<dim> &image, const LabelPiece<dim> &piece)
{
  using Pixel                     = typename LabelImage<dim>::Pixel;
  const std::vector<bool> belongs = pixels_of(image, piece);
  std::vector<Pixel>      pixels;
  pixels.reserve(piece.n_pixels);
  std::size_t k = 0;
  for_each_row<dim>(piece.lower, piece.upper, [&](Pixel pixel) {
    for (; pixel[0] <= piece.upper[0]; ++pixel[0], ++k)
      if (belongs[k])
        pixels.push_back(pixel);
  });
  return pixels;
}

template <int dim>
std::uint32_t
merge_into_neighbour(const LabelPiece<dim> &piece, LabelImage<dim> &image)
{
  using Pixel                                 = typename LabelImage<dim>::Pixel;
  const std::vector<Pixel>             pixels = list_of_pixels(image, piece);
  std::map<std::uint32_t, std::size_t> n_sides; // in common
  for (const Pixel &pixel : pixels)
    for_each_neighbour(image, pixel, [&](const Pixel &neighbour) {
      if (const std::uint32_t label = image(neighbour); label != 0 && label != piece.label)
        ++n_sides[label];
    });
  if (n_sides.empty())
    return 0;
  const std::uint32_t label
    = std::max_element(n_sides.begin(), n_sides.end(), [](const auto &a, const auto &b) {
        return a.second < b.second;
      })->first;
  for (const Pixel &pixel : pixels)
    image.set(pixel, label);
  return label;
}

#define SCREE_INSTANTIATE(dim)                                                                       \
  template class LabelImage<dim>;                                                                    \
  template std::vector<LabelPiece<dim>> pieces_of(const LabelImage<dim> &);                          \
  template std::vector<bool>            pixels_of(const LabelImage<dim> &, const LabelPiece<dim> &); \
  template std::vector<typename LabelImage<dim>::Pixel> list_of_pixels(const LabelImage<dim> &,      \
                                                                       const LabelPiece<dim> &);     \
  template std::uint32_t merge_into_neighbour(const LabelPiece<dim> &, LabelImage<dim> &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
