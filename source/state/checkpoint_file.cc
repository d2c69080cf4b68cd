#include <scree/base/exceptions.h>
#include <scree/state/checkpoint_file.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <istream>
#include <limits>
#include <ostream>
#include <streambuf>
#include <unistd.h>
#include <vector>
#include <zlib.h>

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
constexpr std::uint32_t format   = 12;

/** Why a file is no usable checkpoint. */
struct Damage
{
  std::string what;
};

/** Counts the bytes that are written to it. */
class CountingBuffer : public std::streambuf
{
public:
  std::uint64_t n_bytes = 0;

protected:
  int_type overflow(const int_type byte) override
  {
    n_bytes += 1;
    return traits_type::not_eof(byte);
  }

  std::streamsize xsputn(const char *, const std::streamsize n) override
  {
    n_bytes += n;
    return n;
  }
};

/** Writes to a file in pieces and holds the CRC-32 of what was written. The stream never fails, for
 * archives throw then: finish() tells the error. */
class FileBuffer : public std::streambuf
{
public:
  explicit FileBuffer(const std::string &file_name)
      : file(open(file_name.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NONBLOCK,
                  0666)) // a pipe that nobody reads is an error
      , error(file < 0 ? errno : 0)
      , piece(1u << 20)
  {
    setp(piece.data(), piece.data() + piece.size());
  }

  ~FileBuffer() override
  {
    if (file >= 0)
      close(file);
  }

  std::uint32_t checksum()
  {
    sync();
    return crc;
  }

  /** Waits until all is on the disk and closes the file. Returns the first error number, 0: none.
   */
  int finish()
  {
    sync();
    if (error == 0 && fsync(file) != 0)
      error = errno;
    if (file >= 0 && close(file) != 0 && error == 0)
      error = errno;
    file = -1;
    return error;
  }

protected:
  int_type overflow(const int_type byte) override
  {
    sync();
    return traits_type::eq_int_type(byte, traits_type::eof())
             ? traits_type::not_eof(byte)
             : sputc(traits_type::to_char_type(byte));
  }

  int sync() override
  {
    write_out(pbase(), pptr() - pbase());
    setp(piece.data(), piece.data() + piece.size());
    return 0;
  }

  std::streamsize xsputn(const char *bytes, const std::streamsize n) override
  {
    if (n > epptr() - pptr())
      sync();
    if (n > epptr() - pptr())
      write_out(bytes, n);
    else
      {
        std::memcpy(pptr(), bytes, n);
        pbump(static_cast<int>(n));
      }
    return n;
  }

private:
  void write_out(const char *bytes, const std::size_t n)
  {
    crc = crc32_z(crc, reinterpret_cast<const unsigned char *>(bytes), n);
    for (std::size_t first = 0; first < n && error == 0;)
      {
        const ssize_t written = write(file, bytes + first, n - first);
        if (written > 0)
          first += written;
        else if (written == 0 || errno != EINTR)
          error = written == 0 ? ENOSPC : errno;
      }
  }

  int               file, error;
  std::uint32_t     crc = 0;
  std::vector<char> piece;
};

/** Bytes of a whole file around its contents. */
std::uint64_t
size_of_file(const Header &header)
{
  return sizeof header + header.size + sizeof(std::uint32_t);
}

/** The header of a file that has as many bytes as it says. */
Header
read_header(std::istream &file, const std::uint64_t size)
{
  Header header{};
  if (!file.read(reinterpret_cast<char *>(&header), sizeof header)
      || std::memcmp(header.mark, mark, sizeof mark) != 0)
    throw Damage{"is not a checkpoint of scree"};
  // A size that cannot be has been damaged: its sum with the others may be beyond all numbers.
  if (header.size > std::numeric_limits<std::uint64_t>::max() / 2 || size > size_of_file(header))
    throw Damage{"is damaged: it has " + std::to_string(size) + " bytes, its header says "
                 + std::to_string(header.size) + " for the contents"};
  if (size < size_of_file(header))
    throw Damage{"is incomplete: it has " + std::to_string(size) + " of "
                 + std::to_string(size_of_file(header)) + " bytes"};
  return header;
}

std::string
read_contents(const std::string &file_name, const unsigned int dimension)
{
  std::error_code error;
  if (!std::filesystem::is_regular_file(file_name, error)) // a pipe would be waited for
    throw Damage{"cannot be read: it is no regular file"};
  const std::uint64_t size = std::filesystem::file_size(file_name, error);
  std::ifstream       file(file_name, std::ios::binary);
  if (error || !file.good())
    throw Damage{"cannot be read"};
  const Header  header = read_header(file, size);
  std::uint32_t crc    = 0;
  std::string   contents(header.size, '\0');
  if (!file.read(contents.data(), contents.size())
      || !file.read(reinterpret_cast<char *>(&crc), sizeof crc))
    throw Damage{"cannot be read"};
  const auto bytes_of = [](const void *data) { return static_cast<const unsigned char *>(data); };
  if (crc
      != crc32_z(crc32_z(0, bytes_of(&header), sizeof header), bytes_of(contents.data()),
                 contents.size()))
    throw Damage{"is damaged: its checksum is wrong"};
  if (header.format != format)
    throw Damage{"is of format " + std::to_string(header.format)
                 + ", but this version of scree reads format " + std::to_string(format)
                 + " (log.txt tells which version wrote it)"};
  if (header.dimension != dimension)
    throw Damage{"is of a run in " + std::to_string(header.dimension) + " dimensions, not "
                 + std::to_string(dimension) + " (use the parameters.prm that the run wrote)"};
  return contents;
}
} // namespace

std::size_t
write_checkpoint_file(const std::string &directory, const unsigned int dimension,
                      const std::function<void(std::ostream &)> &write_contents)
{
  CountingBuffer counter;
  std::ostream   counted(&counter);
  write_contents(counted);
  Header header{};
  std::memcpy(header.mark, mark, sizeof mark);
  header.format    = format;
  header.dimension = dimension;
  header.size      = counter.n_bytes;

  const std::size_t n_bytes = size_of_file(header);
  const std::string newest = directory + "/checkpoint", next = newest + ".new";
  const auto        require_done = [&](const int error) {
    if (error != 0)
      std::remove(next.c_str());
    require(error == 0, next,
                   "the checkpoint of " + std::to_string(n_bytes)
                     + " bytes cannot be written: " + std::strerror(error),
                   "make room on the disk; the run goes on, and the checkpoint before this one remains");
  };
  const auto write_to_disk = [&]() {
    FileBuffer   buffer(next);
    std::ostream file(&buffer);
    file.write(reinterpret_cast<const char *>(&header), sizeof header);
    write_contents(file);
    const std::uint32_t crc = buffer.checksum();
    file.write(reinterpret_cast<const char *>(&crc), sizeof crc);
    return buffer.finish();
  };
  require_done(write_to_disk());
  require_done(
    std::rename(newest.c_str(), (newest + ".old").c_str()) != 0 && errno != ENOENT ? errno : 0);
  require_done(std::rename(next.c_str(), newest.c_str()) != 0 ? errno : 0);
  const int folder = open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder >= 0)
    {
      fsync(folder);
      close(folder);
    }
  return n_bytes;
}

bool
has_checkpoint(const std::string &directory)
{
  return std::filesystem::exists(directory + "/checkpoint")
         || std::filesystem::exists(directory + "/checkpoint.old");
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
      return {read_contents(older, dimension), warning + "; the one before it is used"};
    }
  catch (const Damage &damage)
    {
      throw UserError(directory, warning + "; " + older + " " + damage.what, anew);
    }
}

void
set_damaged_aside(const std::string &directory)
{
  std::rename((directory + "/checkpoint").c_str(), (directory + "/checkpoint.damaged").c_str());
}
} // namespace scree
