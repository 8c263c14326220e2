// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cstdint>
#include <filesystem>
#include <string>

#include "formats/eclipse/eclipse.h"

// The first byte chooses the format; the rest is the file. What is read goes through the writers into files that are
// never committed.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace geomend;
    if (size < 1) return 0;
    const auto rows = eclipse::formats();
    const Format& row = rows[data[0] % rows.size()];
    const std::string content(reinterpret_cast<const char*>(data) + 1, size - 1);
    for (const Format& other : rows) other.sniff(content, "fuzz");
    const auto dataset = row.read(Input::from_memory(content, "fuzz"), {});
    if (!dataset) {
        if (dataset.why().error.code.empty()) __builtin_trap();
        return 0;
    }
    for (const Format& other : rows) {
        if (other.write == nullptr) continue;
        OutputSet out(std::filesystem::temp_directory_path() / "geomend_fuzz_eclipse");
        static_cast<void>(other.write(*dataset, out, {}).ok());
    }
    return 0;
}
