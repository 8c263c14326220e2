// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "base/input.h"
#include "formats/gocad/object_scanner.h"

namespace geomend::gocad {

/// The files that an object names for its arrays, each opened once.
class CompanionFiles {
public:
    explicit CompanionFiles(ObjectScanner& scanner) : scanner_(scanner) {}

    /// `size` bytes of a file from `offset`. Told as errors: F010 where the file is missing (the name with ".vo" at its
    /// end is tried, too, as programs that serve such files add it), F011 where it is too short, F014 where the same
    /// bytes are asked for so often that memory would run out.
    /// \param line of the record that names the file
    /// \return an empty view after an error
    std::string_view bytes(const std::string& name, std::uint64_t offset, std::uint64_t size, std::uint64_t line);

    /// The whole file.
    std::string_view all(const std::string& name, std::uint64_t line);

    /// True after an error.
    bool failed() const { return failed_; }

    /// Tells of files that hold more than was asked for (F107).
    void report_rest();

private:
    struct File {
        Input input;
        std::uint64_t used_to = 0;
        std::uint64_t line = 0;
    };
    File* open(const std::string& name, std::uint64_t line);

    ObjectScanner& scanner_;
    std::map<std::string, File> files_;
    std::uint64_t held_ = 0;   // bytes in all files
    std::uint64_t asked_ = 0;  // bytes given out
    bool failed_ = false;
};

}  // namespace geomend::gocad
