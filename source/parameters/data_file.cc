#include <scree/base/exceptions.h>
#include <scree/base/text_file.h>
#include <scree/parameters/data_file.h>

#include <boost/crc.hpp>
#include <iomanip>
#include <sstream>

namespace scree
{
namespace
{
/** CRC-32 in hexadecimal digits. */
std::string
checksum_of(const std::string &bytes)
{
  boost::crc_32_type crc;
  crc.process_bytes(bytes.data(), bytes.size());
  std::ostringstream text;
  text << std::hex << std::setw(8) << std::setfill('0') << crc.checksum();
  return text.str();
}
} // namespace

CheckedTable
checked_table(const ParameterSection &section, const std::string &key, const TableCall &call)
{
  require(!call.file.empty(), key, "table() names no file", "write table(load.csv)");
  const std::string path = section.found_file(key, call.file);
  require(path.find_first_of(",;()") == std::string::npos, key,
          "the file '" + path + "' cannot be named in a formula",
          "move it to where the path has none of the characters , ; ( )");
  const std::string bytes = read_time_table_bytes(path);
  const TimeTable   table(checked_text(bytes, path), path);
  const std::string found = checksum_of(bytes);
  require(call.checksum.empty() || call.checksum == found, key,
          "the file '" + path + "' has changed, its checksum is " + found,
          "take the file of before, or write table(FILE) without a checksum");
  return {"table(" + path + ", " + found + ")", table};
}

bool
declare_checksum(const ParameterSection &section, const std::string &path, const std::string &bytes)
{
  const std::string found    = bytes.empty() ? "" : checksum_of(bytes);
  std::string       expected = found;
  section.entry("Checksum", expected,
                "CRC-32 of the file, written by the program: another file is then refused.");
  if (expected != found && !bytes.empty())
    section.error("Checksum", "the file '" + path + "' has changed, its checksum is " + found,
                  "take the file of before, or remove the entry");
  return expected == found;
}

std::string
read_data_file(const ParameterSection &section, const std::string &key, std::string &path,
               const std::size_t largest_size, const std::string &what,
               const std::string &documentation,
               const std::function<std::string(const std::string &, const std::string &)> &complete)
{
  section.file(key, path, documentation);
  std::string bytes;
  if (path.empty())
    section.error(key, "is needed", "name a file of " + what);
  else
    try
      {
        bytes = read_bytes(path, largest_size, path, "check the path", what);
        if (bytes.empty())
          section.error(key, "the file '" + path + "' is empty", "choose the right file");
        if (complete)
          bytes = complete(bytes, path);
      }
    catch (const UserError &error)
      {
        section.error(key, error.what());
      }
  return declare_checksum(section, path, bytes) ? bytes : "";
}
} // namespace scree
