// A child that has been taken over by the file that it reads, as its parent sees it: any bytes, and the end.
#pragma once

#include "base/confined/reader.h"
#include "base/error.h"

#include <array>
#include <cstring>
#include <functional>
#include <gtest/gtest.h>
#include <initializer_list>
#include <string>
#include <string_view>
#include <sys/socket.h>
#include <utility>

namespace shadowbench::test {

/// Numbers as they stand in an answer.
inline std::string numbers(std::initializer_list<std::uint64_t> values) {
    std::string bytes;
    for (const std::uint64_t value : values) bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    return bytes;
}

/// What `receive` refuses the answer with; "" if it takes it.
inline std::string refusalOf(std::string_view answer, const std::function<void(ReaderChild&)>& receive) {
    std::array<int, 2> ends{};
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()), 0);
    Descriptor ours(ends[0]);
    {
        const Descriptor childs(ends[1]);
        EXPECT_EQ(::send(childs.get(), answer.data(), answer.size(), MSG_NOSIGNAL), static_cast<ssize_t>(answer.size()));
    }
    ReaderChild child("cannot read a.png", std::move(ours));
    try {
        receive(child);
        return "";
    } catch (const BadInput& error) {
        return error.what();
    }
}

} // namespace shadowbench::test
