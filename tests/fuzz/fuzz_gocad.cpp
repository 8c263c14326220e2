// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cstdint>
#include <string>

#include "formats/gocad/gocad.h"

// All types share one reader; a file may hold any of them.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace geomend;
    const std::string content(reinterpret_cast<const char*>(data), size);
    const Format& row = gocad::formats().front();
    row.sniff(content, "fuzz");
    const auto dataset = row.read(Input::from_memory(content, "fuzz"), {});
    if (!dataset && dataset.why().error.code.empty()) __builtin_trap();
    return 0;
}
