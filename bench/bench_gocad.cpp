// SPDX-License-Identifier: AGPL-3.0-or-later
// How fast Gocad files are read and written, against a bare pass of from_chars (to_chars) over the same numbers on one
// thread in the same run. Figures to look at: the ratio of read/parallel to bare_from_chars, and the peak memory that
// read_memory tells against the arrays that come out.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "formats/gocad/read_gocad.h"
#include "formats/gocad/write_gocad.h"

namespace {

using namespace geomend;

// A Model3d of 16 bodies with 55 surfaces each, about 780,000 triangles and 60 MB: coordinates are float32 offsets from
// a local origin printed with 17 digits, as Gocad prints them.
std::string synthetic_model() {
    constexpr int surfaces = 880, side = 21;
    std::string header = "GOCAD Model3d 1\nHEADER {\nname:synthetic\n}\n", regions, body;
    std::array<char, 64> text{};
    const auto real = [&](std::string& out, double value) {
        std::snprintf(text.data(), text.size(), "%.17g", value);
        out += text.data();
    };
    for (int s = 0; s != surfaces; ++s) header += "TSURF s" + std::to_string(s) + '\n';
    for (int s = 0; s != surfaces; ++s) {
        const auto corner = [&](std::string& out, int i, int j) {
            real(out, 4e5 + static_cast<double>(static_cast<float>(25.3 * i + 0.37 * j + 900.1 * (s % 7))) * 1.000000001);
            out += ' ';
            real(out, 5.3e6 + static_cast<double>(static_cast<float>(31.7 * j - 0.11 * i)) * 1.000000001);
            out += ' ';
            real(out,
                 -static_cast<double>(static_cast<float>(1000 + 40.0 * s + 90 * std::sin(0.13 * i) * std::cos(0.21 * j))) * 1.000000001);
        };
        header += "TFACE " + std::to_string(s + 1) + "  none s" + std::to_string(s) + "\n  ";
        corner(header, 0, 0);
        header += "\n  ";
        corner(header, 1, 0);
        header += "\n  ";
        corner(header, 1, 1);
        header += '\n';
        body += "GOCAD TSurf 1\nHEADER {\nname:s" + std::to_string(s) + "\n}\nTFACE\n";
        for (int j = 0; j <= side; ++j) {
            for (int i = 0; i <= side; ++i) {
                body += "VRTX " + std::to_string(1 + i + j * (side + 1)) + ' ';
                corner(body, i, j);
                body += " \n";
            }
        }
        for (int j = 0; j != side; ++j) {
            for (int i = 0; i != side; ++i) {
                const int a = 1 + i + j * (side + 1), b = a + 1, c = b + side + 1, d = a + side + 1;
                body += "TRGL " + std::to_string(a) + ' ' + std::to_string(b) + ' ' + std::to_string(c) + " \n";
                body += "TRGL " + std::to_string(a) + ' ' + std::to_string(c) + ' ' + std::to_string(d) + " \n";
            }
        }
        body += "END\n";
    }
    return header + "END\n" + body;
}

const std::string& model_text() {
    static const std::string text = synthetic_model();
    return text;
}

// The file on disk, so that reading maps it as in real life.
const std::string& model_path() {
    static const std::string path = [] {
        std::string name = (std::filesystem::temp_directory_path() / ("bench_gocad_" + std::to_string(::getpid()) + ".ml")).string();
        std::ofstream(name, std::ios::binary) << model_text();
        return name;
    }();
    return path;
}

// The least that a reader of this text has to do: turn every number into a value.
void bare_from_chars(benchmark::State& state) {
    const auto input = Input::open(model_path());
    const std::string_view text = input->bytes();
    for (auto _ : state) {
        const char* p = text.data();
        const char* const end = p + text.size();
        double sum = 0;
        while (p != end) {
            if ((*p >= '0' && *p <= '9') || *p == '-' || *p == '+') {
                double value = 0;
                const auto [stop, error] = std::from_chars(p, end, value);
                sum += value;
                p = stop == p ? p + 1 : stop;
            } else {
                ++p;
            }
        }
        benchmark::DoNotOptimize(sum);
    }
    state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * text.size()));
}

std::size_t array_bytes(const Dataset& dataset) {
    std::size_t bytes = 0;
    for (const Object& object : dataset.objects) {
        const auto& s = std::get<Surface>(object);
        bytes += s.points.size() * sizeof(Vec3) + s.polygons.corners.size() * 4 + s.labels.ids.size() * 8 + s.alias.size() * 4;
    }
    return bytes;
}

// A line of /proc/self/status in bytes, e.g. "VmHWM:".
double status_bytes(const std::string& key) {
    std::ifstream status("/proc/self/status");
    std::string word;
    double value = 0;
    while (status >> word) {
        if (word == key) status >> value;
    }
    return 1024 * value;
}

// The peak that one reading adds to what the process holds, without the mapped file.
double peak_of_reading() {
    std::ofstream("/proc/self/clear_refs") << 5;
    const double before = status_bytes("VmRSS:");
    const auto input = Input::open(model_path());
    const auto dataset = gocad::read_gocad(*input, {});
    benchmark::DoNotOptimize(dataset.ok());
    return status_bytes("VmHWM:") - before - static_cast<double>(input->bytes().size());
}

void read_model(benchmark::State& state) {
    std::size_t triangles = 0, bytes = 0;
    const double peak = peak_of_reading();
    for (auto _ : state) {
        const auto input = Input::open(model_path());
        const auto dataset = gocad::read_gocad(*input, {});
        if (!dataset) {
            state.SkipWithError(dataset.why().error.message.c_str());
            return;
        }
        triangles = 0;
        for (const Object& object : dataset->objects) triangles += std::get<Surface>(object).polygons.size();
        bytes = array_bytes(*dataset);
    }
    state.counters["triangles"] = static_cast<double>(triangles);
    state.counters["peak_MB"] = peak / 1e6;
    state.counters["array_MB"] = static_cast<double>(bytes) / 1e6;
    state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * model_text().size()));
}

void bare_to_chars(benchmark::State& state) {
    const auto dataset = gocad::read_gocad(*Input::open(model_path()), {});
    std::array<char, 64> text{};
    std::size_t bytes = 0;
    for (auto _ : state) {
        bytes = 0;
        for (const Object& object : dataset->objects) {
            const auto& s = std::get<Surface>(object);
            for (const Vec3& at : s.points) {
                for (const double x : at)
                    bytes += static_cast<std::size_t>(std::to_chars(text.data(), text.data() + 64, x).ptr - text.data());
            }
            for (const std::uint32_t c : s.polygons.corners) {
                bytes += static_cast<std::size_t>(std::to_chars(text.data(), text.data() + 64, c).ptr - text.data());
            }
        }
        benchmark::DoNotOptimize(bytes);
    }
    state.counters["MB"] = static_cast<double>(bytes) / 1e6;
}

void write_model(benchmark::State& state) {
    const auto dataset = gocad::read_gocad(*Input::open(model_path()), {});
    for (auto _ : state) {
        OutputSet files(model_path() + ".out");
        const auto losses = gocad::write_model3d(*dataset, files, {});
        if (!losses) state.SkipWithError("cannot write");
    }
}

BENCHMARK(bare_from_chars)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(read_model)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(bare_to_chars)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(write_model)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
    std::filesystem::remove(model_path());
}
