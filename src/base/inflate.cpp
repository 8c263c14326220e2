// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/inflate.h"

#include <zlib.h>

#include <algorithm>
#include <new>

namespace geomend {

namespace {

constexpr std::size_t most_at_once = std::size_t{1} << 30;

struct Inflater {
    z_stream stream{};
    bool ready;
    explicit Inflater(int window) : ready(::inflateInit2(&stream, window) == Z_OK) {
        if (!ready) throw std::bad_alloc();
    }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;
    ~Inflater() { ::inflateEnd(&stream); }

    struct Step {
        int status;
        std::size_t consumed, produced;
    };
    Step go_on(std::string_view packed, char* to, std::size_t room) {
        const std::size_t offer = std::min(packed.size(), most_at_once);
        const std::size_t place = std::min(room, most_at_once);
        stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
        stream.avail_in = static_cast<uInt>(offer);
        stream.next_out = reinterpret_cast<Bytef*>(to);
        stream.avail_out = static_cast<uInt>(place);
        const int status = ::inflate(&stream, Z_NO_FLUSH);
        return {status, offer - stream.avail_in, place - stream.avail_out};
    }
};

Failure damaged(const Inflater& inflater, int status, const std::string& name, std::size_t at) {
    const z_stream& z = inflater.stream;
    const std::string what = status == Z_OK || status == Z_BUF_ERROR ? "end early" : (z.msg != nullptr ? z.msg : "cannot be inflated");
    return unreadable("F015", {name, 0, 0, static_cast<std::int64_t>(at)}, "the gzip data are damaged: " + what);
}

std::string bytes_in_words(std::size_t bytes) {
    constexpr std::size_t gib = std::size_t{1} << 30, mib = std::size_t{1} << 20;
    return bytes >= gib ? std::to_string(bytes / gib) + " GiB" : std::to_string(bytes / mib) + " MiB";
}

}  // namespace

bool is_gzip(std::string_view bytes) { return bytes.size() >= 3 && bytes[0] == '\x1f' && bytes[1] == '\x8b' && bytes[2] == '\x08'; }

Result<std::string> inflate_gzip(std::string_view packed, const std::string& name, std::size_t most) {
    constexpr int gzip_window = 15 + 16;
    constexpr std::size_t chunk = std::size_t{1} << 20;
    Inflater inflater(gzip_window);
    std::string out;
    std::size_t used = 0;
    std::size_t taken = 0;
    bool member_ended = false;
    while (taken < packed.size() || !member_ended) {
        const std::size_t spare = std::min(chunk, 4 * packed.size() + 64);  // small data take little memory
        if (out.size() - used < spare) out.resize(out.size() + out.size() / 2 + spare);
        const Inflater::Step step = inflater.go_on(packed.substr(taken), out.data() + used, out.size() - used);
        used += step.produced;
        taken += step.consumed;
        if (used > most) return unreadable("F014", {name}, "the compressed data grow beyond " + bytes_in_words(most));
        member_ended = step.status == Z_STREAM_END;
        if (member_ended) {
            if (!is_gzip(packed.substr(taken))) break;
            ::inflateReset(&inflater.stream);
            member_ended = false;
        } else if (step.status != Z_OK || (step.produced == 0 && step.consumed == 0)) {
            return damaged(inflater, step.status, name, taken);
        }
    }
    out.resize(used);
    return out;
}

Result<std::string> inflate_exactly(std::string_view packed, std::size_t size, const std::string& name) {
    constexpr int bare_window = -15;
    Inflater inflater(bare_window);
    std::string out(size + 1, '\0');  // one more byte shows that there is too much
    std::size_t used = 0;
    std::size_t taken = 0;
    for (;;) {
        const Inflater::Step step = inflater.go_on(packed.substr(taken), out.data() + used, out.size() - used);
        used += step.produced;
        taken += step.consumed;
        if (step.status == Z_STREAM_END) break;
        if (used > size)
            return unreadable("F015", {name}, "the compressed data give more than the " + std::to_string(size) + " bytes stated");
        if (step.status != Z_OK || (step.produced == 0 && step.consumed == 0)) return damaged(inflater, step.status, name, taken);
    }
    if (used != size)
        return unreadable("F015", {name},
                          "the compressed data give " + std::to_string(used) + " bytes, not the " + std::to_string(size) + " stated");
    out.resize(size);
    return out;
}

}  // namespace geomend
