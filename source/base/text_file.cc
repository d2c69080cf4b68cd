#include <scree/base/exceptions.h>
#include <scree/base/text_file.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace scree
{
namespace
{
namespace fs = std::filesystem;

bool
begins_with(const std::string &bytes, const std::string &mark)
{
  return bytes.compare(0, mark.size(), mark) == 0;
}

/** The encoding that the first bytes tell, if it is none that is read. */
std::string
foreign_encoding(const std::string &bytes)
{
  using namespace std::string_literals;
  if (begins_with(bytes, "\xff\xfe\0\0"s) || begins_with(bytes, "\0\0\xfe\xff"s))
    return "UTF-32";
  if (begins_with(bytes, "\xff\xfe"s) || begins_with(bytes, "\xfe\xff"s))
    return "UTF-16";
  // Without a mark, every other byte of plain text is NUL.
  if (bytes.size() >= 4 && ((bytes[0] == 0) != (bytes[1] == 0))
      && (bytes[0] == 0) == (bytes[2] == 0) && (bytes[1] == 0) == (bytes[3] == 0))
    return "UTF-16";
  return "";
}
} // namespace

std::string
checked_text(const std::string &bytes, const std::string &name)
{
  const std::string encoding = foreign_encoding(bytes);
  require(encoding.empty(), name, "the file is encoded as " + encoding, "save it as UTF-8");

  std::string  text;
  unsigned int line = 1;
  text.reserve(bytes.size());
  for (std::size_t i = begins_with(bytes, "\xef\xbb\xbf") ? 3 : 0; i < bytes.size(); ++i)
    {
      const auto byte = static_cast<unsigned char>(bytes[i]);
      if (byte == '\n' || byte == '\r')
        {
          text += '\n';
          ++line;
          if (byte == '\r' && i + 1 < bytes.size() && bytes[i + 1] == '\n')
            ++i;
          continue;
        }
      if ((byte < 32 && byte != '\t' && byte != '\f' && byte != '\v') || byte == 127)
        {
          char code[8];
          std::snprintf(code, sizeof code, "0x%02x", byte);
          throw UserError(name + ":" + std::to_string(line),
                          "there is a control character (" + std::string(code)
                            + (byte == 0 ? ", NUL" : "") + "), which no text has",
                          "write the line anew in a text editor, or choose the right file");
        }
      text += bytes[i];
    }
  return text;
}

std::string
read_bytes(const std::string &path, const std::size_t largest_size, const std::string &where,
           const std::string &remedy, const std::string &what)
{
  std::error_code       error;
  const fs::file_status status = fs::status(path, error);
  require(!error && fs::exists(status), where, "cannot open the file '" + path + "'", remedy);
  require(!fs::is_directory(status), where, "'" + path + "' is a directory", "name a file");
  require(fs::is_regular_file(status), where,
          "'" + path + "' is no regular file but a pipe or a device",
          "write what it gives to a file, and name that");
  const auto size = fs::file_size(path, error);
  require(!error && size <= largest_size, where,
          "the file '" + path + "' of " + std::to_string(size / 1000000) + " MB is too large for "
            + what,
          "choose the right file; " + what + " may have " + std::to_string(largest_size / 1000000)
            + " MB");
  std::ifstream in(path, std::ios::binary);
  require(in.is_open(), where, "cannot open the file '" + path + "'", remedy);
  std::string bytes(size, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(size));
  // A special file, for example of /proc, may tell another size than it has.
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
  return bytes;
}

void
require_regular_if_there(const std::string &path)
{
  std::error_code       error;
  const fs::file_status status = fs::status(path, error);
  require(!fs::exists(status) || fs::is_regular_file(status), path,
          fs::is_directory(status) ? "is a directory, no file"
                                   : "is no regular file but a pipe or a device",
          "remove it: the run writes there");
}

std::string
read_text_file(const std::string &path, const std::size_t largest_size, const std::string &where,
               const std::string &remedy, const std::string &what)
{
  return checked_text(read_bytes(path, largest_size, where, remedy, what), path);
}

std::vector<DataLine>
data_lines(const std::string &text, const std::string &name)
{
  std::vector<DataLine> lines;
  std::istringstream    in(text);
  std::string           line;
  for (std::size_t n = 1; std::getline(in, line); ++n)
    {
      line = dealii::Utilities::trim(line.substr(0, line.find('#')));
      if (!line.empty())
        lines.push_back({line, name + ":" + std::to_string(n), n});
    }
  return lines;
}
} // namespace scree
