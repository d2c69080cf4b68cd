#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace scree
{
/**
 * The bytes of a file of `what`, as "parameters" or "labels".
 *
 * @param largest_size the most bytes that are read
 * @param where        what asked for the file, for messages
 * @param remedy       what to do if it cannot be opened
 * @throws UserError if the file cannot be opened, is no regular file (directories, pipes and
 *   devices are never opened, so that nothing waits for them), or is too large
 */
std::string read_bytes(const std::string &path, const std::size_t largest_size,
                       const std::string &where, const std::string &remedy,
                       const std::string &what);

/**
 * @throws UserError if there is something at `path` that is no regular file: a pipe would keep a
 * run that writes there waiting for ever
 */
void require_regular_if_there(const std::string &path);

/**
 * What stands in a text file, with lines that end in '\n' whatever they ended in (LF, CR LF, CR)
 * and without the mark of UTF-8 at its begin.
 *
 * @throws UserError if read_bytes() does, or the file is encoded as UTF-16 or UTF-32, or holds a
 *   control character, for example NUL, which no text has
 */
std::string read_text_file(const std::string &path, const std::size_t largest_size,
                           const std::string &where, const std::string &remedy,
                           const std::string &what = "parameters");

/** The same for what is in memory already; `name` stands for the file in messages. */
std::string checked_text(const std::string &bytes, const std::string &name);

/** A line of a table. */
struct DataLine
{
  std::string text;   //!< without blanks at its ends
  std::string where;  //!< NAME:NUMBER, for messages
  std::size_t number; //!< from 1
};

/** The lines of a text in which there is something before a #. */
std::vector<DataLine> data_lines(const std::string &text, const std::string &name);
} // namespace scree
