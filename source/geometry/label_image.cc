#include <scree/geometry/label_image.h>

#include <algorithm>
#include <numeric>

namespace scree
{
LabelImage::LabelImage(const std::array<int, 2> &n_pixels, std::vector<Label> labels)
    : n(n_pixels)
    , labels(std::move(labels))
{
  AssertDimension(this->labels.size(), static_cast<std::size_t>(n[0]) * n[1]);
}

namespace
{
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

/** Pixels of equal label side by side. */
struct Run
{
  LabelImage::Label label;
  int               first, last, row;
};

/** The runs of all labels but 0, row by row from below. */
std::vector<Run>
runs_of(const LabelImage &image)
{
  std::vector<Run> runs;
  const auto      &n = image.n_pixels();
  for (int j = 0; j < n[1]; ++j)
    for (int i = 0; i < n[0]; ++i)
      if (const auto label = image({{i, j}}); label == 0)
        continue;
      else if (i > 0 && image({{i - 1, j}}) == label)
        runs.back().last = i;
      else
        runs.push_back({label, i, i, j});
  return runs;
}

void
add_run(const Run &run, LabelPiece &piece)
{
  if (piece.n_pixels == 0)
    piece = {run.label, {{run.first, run.row}}, {{run.first, run.row}}, {{run.last, run.row}}, 0};
  piece.lower[0] = std::min(piece.lower[0], run.first);
  piece.upper[0] = std::max(piece.upper[0], run.last);
  piece.upper[1] = run.row;
  piece.n_pixels += run.last - run.first + 1;
}
} // namespace

std::vector<LabelPiece>
pieces_of(const LabelImage &image)
{
  const std::vector<Run> runs = runs_of(image);
  JoinedRuns             joined;
  for (std::size_t r = 0, below = 0; r < runs.size(); ++r)
    {
      joined.add();
      while (runs[below].row < runs[r].row - 1
             || (runs[below].row == runs[r].row - 1 && runs[below].last < runs[r].first))
        ++below;
      for (std::size_t b = below; runs[b].row == runs[r].row - 1 && runs[b].first <= runs[r].last;
           ++b)
        if (runs[b].label == runs[r].label)
          joined.join(b, r);
    }
  constexpr auto           none = static_cast<std::size_t>(-1);
  std::vector<std::size_t> piece_of(runs.size(), none);
  std::vector<LabelPiece>  pieces;
  for (std::size_t r = 0; r < runs.size(); ++r)
    {
      std::size_t &piece = piece_of[joined.root(r)];
      if (piece == none)
        {
          piece = pieces.size();
          pieces.push_back({});
        }
      add_run(runs[r], pieces[piece]);
    }
  std::stable_sort(pieces.begin(), pieces.end(), [](const LabelPiece &a, const LabelPiece &b) {
    return a.label != b.label ? a.label < b.label : a.n_pixels > b.n_pixels;
  });
  return pieces;
}

std::vector<bool>
pixels_of(const LabelImage &image, const LabelPiece &piece)
{
  const int         width = piece.upper[0] - piece.lower[0] + 1;
  std::vector<bool> result(static_cast<std::size_t>(width) * (piece.upper[1] - piece.lower[1] + 1));
  std::vector<LabelImage::Pixel> todo;
  const auto                     visit = [&](const LabelImage::Pixel &pixel) {
    for (unsigned int d = 0; d < 2; ++d)
      if (pixel[d] < piece.lower[d] || pixel[d] > piece.upper[d])
        return;
    const auto place
      = static_cast<std::size_t>(pixel[1] - piece.lower[1]) * width + pixel[0] - piece.lower[0];
    if (result[place] || image(pixel) != piece.label)
      return;
    result[place] = true;
    todo.push_back(pixel);
  };
  visit(piece.first);
  while (!todo.empty())
    {
      const auto [i, j] = todo.back();
      todo.pop_back();
      visit({{i - 1, j}});
      visit({{i + 1, j}});
      visit({{i, j - 1}});
      visit({{i, j + 1}});
    }
  return result;
}
} // namespace scree
