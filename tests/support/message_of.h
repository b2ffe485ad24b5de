// What an error says.
#pragma once

#include "base/error.h"

#include <functional>
#include <string>

namespace shadowbench::test {

/// The sentence of the E that `work` throws; "" where it throws none.
template <typename E = Error>
std::string messageOf(const std::function<void()>& work) {
    try {
        work();
    } catch (const E& error) {
        return error.what();
    }
    return "";
}

} // namespace shadowbench::test
