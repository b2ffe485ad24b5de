// Bytes that stand in a test as text.
#pragma once

#include <string>
#include <string_view>

namespace shadowbench::test {

/// Of two digits each.
inline std::string bytesOf(std::string_view hexadecimal) {
    std::string bytes;
    for (std::size_t i = 0; i < hexadecimal.size(); i += 2)
        bytes += static_cast<char>(std::stoi(std::string(hexadecimal.substr(i, 2)), nullptr, 16));
    return bytes;
}

} // namespace shadowbench::test
