// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cstdint>
#include <filesystem>
#include <string>

#include "formats/grdecl/grdecl.h"

// The first byte says whether what was read is written, too, and whether dims are given; the rest is the deck.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace geomend;
    if (size < 1) return 0;
    const std::string content(reinterpret_cast<const char*>(data) + 1, size - 1);
    const auto rows = grdecl::formats();
    for (const Format& row : rows) row.sniff(content, "fuzz");
    ReadOptions options;
    options.options = {{"max-values", "100000"}};
    if ((data[0] & 2) != 0) options.options.emplace_back("dims", "2,1,2");
    const auto dataset = rows[0].read(Input::from_memory(content, "fuzz.grdecl"), options);
    if (!dataset) {
        if (dataset.why().error.code.empty()) __builtin_trap();
        return 0;
    }
    if ((data[0] & 1) == 0) return 0;
    OutputSet out(std::filesystem::temp_directory_path() / "geomend-fuzz.grdecl");  // never committed
    static_cast<void>(rows[size % rows.size()].write(*dataset, out, {}));
    return 0;
}
