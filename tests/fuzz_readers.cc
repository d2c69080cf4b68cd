/* What contrib/checks/fuzz_readers starts: the readers of data files in one process, thousands of
 * files a second.
 *
 * usage: fuzz_readers FILE
 *
 * Reads frames from the standard input, a line `NAME SIZE` and SIZE bytes, the contents of a file
 * of that name, and gives them to the reader of its kind; a table goes into FILE first. Answers
 * each by a line: `read`, `refused` if the reader says why, or what else it threw.
 */
#include <scree/base/exceptions.h>
#include <scree/bodies/body.h>
#include <scree/geometry/closed_surface.h>
#include <scree/geometry/label_image.h>
#include <scree/geometry/volume_header.h>
#include <scree/parameters/file.h>

#include <algorithm>
#include <exception>
#include <fstream>
#include <iostream>
#include <string>

namespace
{
using namespace scree;

std::string file_of_table;

bool
ends_with(const std::string &text, const std::string &end)
{
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/** The members of a family, of which `bytes` are the table. */
void
read_list(const std::string &bytes)
{
  std::ofstream(file_of_table, std::ios::binary) << bytes;
  ParameterFile file = ParameterFile::from_string(
    "set Names = grain\nsubsection grain\n set Material = rock\n set Family = list\n"
    " subsection List\n  set File = "
    + file_of_table + "\n end\nend\n");
  ParameterSection section = file.root();
  const auto       bodies  = declare_bodies<2>(section, {{"rock", {}}});
  file.check();
}

void
read(const std::string &name, const std::string &bytes)
{
  if (ends_with(name, ".csv"))
    read_list(bytes);
  else if (ends_with(name, ".stl") || ends_with(name, ".ply") || ends_with(name, ".obj"))
    ClosedSurface(TriangleSoup::read(bytes, name), name).volume();
  else if (ends_with(name, ".nrrd") || ends_with(name, ".mha"))
    pieces_of(LabelImage<3>::read(bytes, name));
  else
    pieces_of(LabelImage<2>::read(bytes, name));
}

std::string
answer(const std::string &name, const std::string &bytes)
{
  try
    {
      read(name, bytes);
      return "read";
    }
  catch (const UserError &)
    {
      return "refused";
    }
  catch (const std::exception &error)
    {
      std::string what = error.what();
      std::replace(what.begin(), what.end(), '\n', ' ');
      return "threw " + what;
    }
}
} // namespace

int
main(int argc, char **argv)
{
  if (argc != 2)
    return 2;
  file_of_table = argv[1];
  std::string name;
  std::size_t size = 0;
  while (std::cin >> name >> size)
    {
      std::string bytes(size, '\0');
      std::cin.get(); // the end of the line
      std::cin.read(bytes.data(), size);
      std::cout << answer(name, bytes) << std::endl;
    }
  return 0;
}
