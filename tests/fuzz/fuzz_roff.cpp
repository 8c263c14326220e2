// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cstdint>
#include <filesystem>
#include <string>

#include "formats/roff/roff.h"

// What is read goes through both writers into files that are never committed.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace geomend;
    const auto rows = roff::formats();
    const std::string content(reinterpret_cast<const char*>(data), size);
    for (const Format& row : rows) row.sniff(content, "fuzz");
    const auto dataset = rows[0].read(Input::from_memory(content, "fuzz"), {});
    if (!dataset) {
        if (dataset.why().error.code.empty()) __builtin_trap();
        return 0;
    }
    for (const Format& row : rows) {
        OutputSet out(std::filesystem::temp_directory_path() / "geomend_fuzz_roff");
        static_cast<void>(row.write(*dataset, out, {}).ok());
    }
    return 0;
}
