// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>

#include "base/monitor.h"

namespace geomend {

/// What stands behind the name of an output.
struct OutputTarget {
    enum class Kind : std::uint8_t {
        file,        ///< a file, or nothing yet: replaced as a whole
        stream,      ///< a device, a pipe or a socket: opened and written into, never replaced or removed
        descriptor,  ///< open in this process already: standard output, /dev/stdout, /dev/fd/3
    };
    Kind kind = Kind::file;
    std::filesystem::path path;  ///< of a file the end of its chain of symbolic links, whether anything is there or not
    int descriptor = -1;
    int error = 0;  ///< errno where nothing can be written: a folder, links in a ring, a file without the right to write
    bool exists = false;
    mode_t mode = 0;  ///< permission bits, owner and group of a file that exists
    uid_t owner = 0;
    gid_t group = 0;

    bool is_file() const { return kind == Kind::file; }
};

/// Looks behind a name; "-" is standard output. Opens nothing and changes nothing.
OutputTarget find_output_target(const std::filesystem::path& name);

/// Gives a file that is to stand in for an existing one its permission bits, its owner and its group. Where the group cannot be
/// given the bits for a group become those for others, so that nobody may do more than before.
void keep_permissions(int file, const OutputTarget& target);

/// Sends all of an open file into a stream or a descriptor. Waits for the reader of a pipe until the monitor (may be null) says
/// stop. Returns 0, or errno: ECANCELED when stopped, EPIPE when the reader has gone (SIGPIPE is not raised).
int send_to_stream(int file, const OutputTarget& target, const Monitor* monitor);

/// Writes all bytes, over interruptions. Returns 0 or errno.
int write_all(int file, const char* bytes, std::size_t size);

}  // namespace geomend
