// SPDX-License-Identifier: AGPL-3.0-or-later
#include "gocad_texts.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace geomend::bench {

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

std::string synthetic_solid() {
    constexpr int side = 46;  // 46^3 * 6 = 584016 tetrahedra
    std::string text = "GOCAD TSolid 1\nHEADER {\nname:synthetic\n}\nPROPERTIES porosity\nNO_DATA_VALUES -99999\nTVOLUME lower\n";
    std::array<char, 128> line{};
    const auto node = [](int i, int j, int k) { return 1 + i + (side + 1) * (j + (side + 1) * k); };
    for (int k = 0; k <= side; ++k) {
        for (int j = 0; j <= side; ++j) {
            for (int i = 0; i <= side; ++i) {
                std::snprintf(line.data(), line.size(), "PVRTX %d %.17g %.17g %.17g %.6g \n", node(i, j, k),
                              451234.5 + i * 17.3 + std::sin(j), 5901234.25 + j * 13.7 + std::cos(k), -1234.5 + k * 7.1 + std::sin(i),
                              0.1 + 0.2 * std::sin(i * j + k));
                text += line.data();
            }
        }
    }
    constexpr std::uint8_t six[6][4] = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};
    for (int k = 0; k < side; ++k) {
        if (k == side / 2) text += "TVOLUME upper\n";
        for (int j = 0; j < side; ++j) {
            for (int i = 0; i < side; ++i) {
                for (const auto& t : six) {
                    std::array<int, 4> n{};
                    for (std::size_t c = 0; c < 4; ++c) n[c] = node(i + (t[c] & 1), j + (t[c] >> 1 & 1), k + (t[c] >> 2));
                    std::snprintf(line.data(), line.size(), "TETRA %d %d %d %d \n# CTETRA %s %s none none none\n", n[0], n[1], n[2], n[3],
                                  k < side / 2 ? "lower" : "upper", k == 0 && &t == six ? "+bottom" : "none");
                    text += line.data();
                }
            }
        }
    }
    return text + "END\n";
}

}  // namespace geomend::bench
