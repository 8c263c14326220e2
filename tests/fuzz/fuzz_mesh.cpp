// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cstdint>
#include <string>
#include <vector>

#include "formats/meshes/meshes.h"

// The first byte chooses the reader. Files of TetGen that stand beside each other are tried by the whole path.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace geomend;
    if (size == 0) return 0;
    std::vector<const Format*> readers;
    for (const Format& row : meshes::formats()) {
        if (row.read != nullptr) readers.push_back(&row);
    }
    const std::string content(reinterpret_cast<const char*>(data + 1), size - 1);
    for (const Format* row : readers) row->sniff(content, "fuzz.node");
    const auto dataset = readers[data[0] % readers.size()]->read(Input::from_memory(content, "fuzz.node"), {});
    if (!dataset && dataset.why().error.code.empty()) __builtin_trap();
    return 0;
}
