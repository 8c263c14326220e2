// SPDX-License-Identifier: AGPL-3.0-or-later
#include <zlib.h>

#include <cstdint>
#include <string>

#include "formats/ringmesh/ringmesh.h"
#include "support/zip_maker.h"

namespace {

/// The files of a pack ("%%% NAME" before each) as an archive, so that changes reach behind its check sums.
std::string archive_of(std::string_view pack) {
    geomend::test::ArchiveFiles files;
    constexpr std::string_view mark = "%%% ";
    for (std::size_t at = pack.find(mark); at != std::string_view::npos;) {
        const std::size_t line = pack.find('\n', at), begin = line == std::string_view::npos ? pack.size() : line + 1;
        const std::size_t next = pack.find(mark, begin);
        files.emplace_back(pack.substr(at + mark.size(), begin - at - mark.size() - 1),
                           pack.substr(begin, next == std::string_view::npos ? next : next - begin));
        at = next;
    }
    return geomend::test::zip_of(files, false);
}

}  // namespace

// The first byte chooses: the bytes of an archive, or a pack of the files in it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace geomend;
    if (size == 0) return 0;
    const Format& row = ringmesh::formats().front();
    std::string content(reinterpret_cast<const char*>(data + 1), size - 1);
    if (data[0] % 2 == 1) content = archive_of(content);
    row.sniff(content, "fuzz.gm");
    const auto dataset = row.read(Input::from_memory(std::move(content), "fuzz"), {});
    if (!dataset && dataset.why().error.code.empty()) __builtin_trap();
    return 0;
}
