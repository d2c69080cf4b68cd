#include <scree/base/exceptions.h>
#include <scree/state/checkpoint_file.h>

#include <boost/crc.hpp>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <unistd.h>

namespace scree
{
namespace
{
/** At the begin of the file, without padding. */
struct Header
{
  char          mark[16];
  std::uint32_t format;
  std::uint32_t dimension;
  std::uint64_t size; //!< of the contents
};

constexpr char          mark[16] = "scree restart\n\x1a";
constexpr std::uint32_t format   = 8;

std::uint32_t
checksum(const std::string &bytes, const std::size_t n)
{
  boost::crc_32_type crc;
  crc.process_bytes(bytes.data(), n);
  return crc.checksum();
}

/** Why a file is no usable checkpoint. */
struct Damage
{
  std::string what;
};

/** Writes and flushes a file; returns the error number, 0: none. */
int
write_to_disk(const std::string &file_name, const std::string &bytes)
{
  const int file = open(file_name.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0)
    return errno;
  int error = 0;
  for (std::size_t first = 0; first < bytes.size() && error == 0;)
    {
      const ssize_t n = write(file, bytes.data() + first, bytes.size() - first);
      if (n > 0)
        first += n;
      else if (n == 0 || errno != EINTR)
        error = n == 0 ? ENOSPC : errno;
    }
  if (error == 0 && fsync(file) != 0)
    error = errno;
  if (close(file) != 0 && error == 0)
    error = errno;
  return error;
}

std::string
read_contents(const std::string &file_name, const unsigned int dimension)
{
  std::ifstream file(file_name, std::ios::binary);
  if (!file.good())
    throw Damage{"cannot be read"};
  std::ostringstream text;
  text << file.rdbuf();
  const std::string bytes = text.str();
  Header            header{};
  std::uint32_t     crc = 0;
  if (bytes.size() < sizeof header + sizeof crc
      || std::memcmp(bytes.data(), mark, sizeof mark) != 0)
    throw Damage{"is not a checkpoint of scree"};
  std::memcpy(&header, bytes.data(), sizeof header);
  if (bytes.size() != sizeof header + header.size + sizeof crc)
    throw Damage{"is incomplete: it has " + std::to_string(bytes.size()) + " of "
                 + std::to_string(sizeof header + header.size + sizeof crc) + " bytes"};
  const std::size_t n = bytes.size() - sizeof crc;
  std::memcpy(&crc, bytes.data() + n, sizeof crc);
  if (crc != checksum(bytes, n))
    throw Damage{"is damaged: its checksum is wrong"};
  if (header.format != format)
    throw Damage{"is of format " + std::to_string(header.format)
                 + ", but this version of scree reads format " + std::to_string(format)
                 + " (log.txt tells which version wrote it)"};
  if (header.dimension != dimension)
    throw Damage{"is of a run in " + std::to_string(header.dimension) + " dimensions, not "
                 + std::to_string(dimension) + " (use the parameters.prm that the run wrote)"};
  return bytes.substr(sizeof header, header.size);
}
} // namespace

std::size_t
write_checkpoint_file(const std::string &directory, const unsigned int dimension,
                      const std::string &contents)
{
  Header header{};
  std::memcpy(header.mark, mark, sizeof mark);
  header.format    = format;
  header.dimension = dimension;
  header.size      = contents.size();
  std::string bytes(reinterpret_cast<const char *>(&header), sizeof header);
  bytes += contents;
  const std::uint32_t crc = checksum(bytes, bytes.size());
  bytes.append(reinterpret_cast<const char *>(&crc), sizeof crc);

  const std::string newest = directory + "/checkpoint", next = newest + ".new";
  const auto        require_done = [&](const int error) {
    if (error != 0)
      std::remove(next.c_str());
    require(error == 0, next,
                   "the checkpoint of " + std::to_string(bytes.size())
                     + " bytes cannot be written: " + std::strerror(error),
                   "make room on the disk; the run goes on, and the checkpoint before this one remains");
  };
  require_done(write_to_disk(next, bytes));
  require_done(
    std::rename(newest.c_str(), (newest + ".old").c_str()) != 0 && errno != ENOENT ? errno : 0);
  require_done(std::rename(next.c_str(), newest.c_str()) != 0 ? errno : 0);
  const int folder = open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder >= 0)
    {
      fsync(folder);
      close(folder);
    }
  return bytes.size();
}

CheckpointContents
read_checkpoint_file(const std::string &directory, const unsigned int dimension)
{
  const std::string newest = directory + "/checkpoint", older = newest + ".old";
  const std::string anew
    = "start the run anew: scree " + directory + "/parameters.prm --output ANOTHER_DIR";
  const bool has_newest = std::filesystem::exists(newest),
             has_older  = std::filesystem::exists(older);
  require(has_newest || has_older, directory,
          "there is no checkpoint: the run ended before its first one "
          "(Output/Checkpoint every, Checkpoint minutes)",
          anew);
  std::string warning = newest + " is missing";
  if (has_newest)
    try
      {
        return {read_contents(newest, dimension), ""};
      }
    catch (const Damage &damage)
      {
        warning = newest + " " + damage.what;
      }
  require(has_older, directory, warning + ", and there is no older one", anew);
  try
    {
      CheckpointContents result{read_contents(older, dimension),
                                warning + "; the one before it is used"};
      // It must not take the place of the older one when the next one is written.
      if (has_newest)
        std::rename(newest.c_str(), (directory + "/checkpoint.damaged").c_str());
      return result;
    }
  catch (const Damage &damage)
    {
      throw UserError(directory, warning + "; " + older + " " + damage.what, anew);
    }
}
} // namespace scree
