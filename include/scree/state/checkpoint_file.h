#pragma once

#include <cstddef>
#include <functional>
#include <iosfwd>
#include <string>

namespace scree
{
/**
 * The file format of checkpoints: a mark, the version of the format, the dimension, the size of the
 * contents, the contents, and the CRC-32 of all that. Numbers are those of the machine: a
 * checkpoint goes with its kind of processor.
 *
 * Writes to DIR/checkpoint.new, waits until it is on the disk, and renames it to DIR/checkpoint;
 * the one before is kept as DIR/checkpoint.old, so that one of the two is complete at any moment.
 * Returns the number of bytes of the file.
 *
 * @param write_contents is called twice, to count the bytes and to write them piece by piece: no
 * copy of all is made
 *
 * @throws UserError if the file cannot be written; then the others are as they were
 */
std::size_t write_checkpoint_file(const std::string &directory, const unsigned int dimension,
                                  const std::function<void(std::ostream &)> &write_contents);

/** Whether a directory holds one, damaged or not. */
bool has_checkpoint(const std::string &directory);

/** What is read of the checkpoints of a directory. */
struct CheckpointContents
{
  std::string contents;
  std::string warning; //!< why an older one was taken; empty: it is the newest
};

/**
 * Reads DIR/checkpoint, or DIR/checkpoint.old if that is missing or damaged.
 *
 * @throws UserError if there is none, none is undamaged, or it is of another format or dimension
 */
CheckpointContents read_checkpoint_file(const std::string &directory, const unsigned int dimension);

/**
 * Renames DIR/checkpoint, if it is there, to DIR/checkpoint.damaged: it must not take the place of
 * the older one that a run has gone on from when the next one is written.
 */
void set_damaged_aside(const std::string &directory);
} // namespace scree
