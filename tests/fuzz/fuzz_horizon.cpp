// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cstdint>
#include <string>

#include "formats/horizon/horizon.h"

// The first byte chooses the format, the second whether z counts depths; the rest is the file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace geomend;
    if (size < 2) return 0;
    const auto rows = horizon::formats();
    const Format& row = rows[data[0] % rows.size()];
    const std::string content(reinterpret_cast<const char*>(data) + 2, size - 2);
    for (const Format& other : rows) other.sniff(content, "fuzz");
    ReadOptions options;
    if ((data[1] & 1) != 0) options.options.emplace_back("z", "depth");
    const auto dataset = row.read(Input::from_memory(content, "fuzz"), options);
    if (!dataset && dataset.why().error.code.empty()) __builtin_trap();
    return 0;
}
