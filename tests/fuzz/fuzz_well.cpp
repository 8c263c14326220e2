// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cstdint>
#include <filesystem>
#include <string>

#include "formats/wells/wells.h"

// The first byte chooses the reader; what is read goes through all writers into files that are never committed.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace geomend;
    if (size == 0) return 0;
    const auto rows = wells::formats();
    const std::string content(reinterpret_cast<const char*>(data + 1), size - 1);
    for (const Format& row : rows) row.sniff(content, "fuzz.w");
    const auto dataset = rows[data[0] % rows.size()].read(Input::from_memory(content, "fuzz"), {});
    if (!dataset) {
        if (dataset.why().error.code.empty()) __builtin_trap();
        return 0;
    }
    for (const Format& row : rows) {
        if (row.write == nullptr) continue;
        OutputSet out(std::filesystem::temp_directory_path() / "geomend_fuzz_well");
        static_cast<void>(row.write(*dataset, out, {}).ok());
    }
    return 0;
}
