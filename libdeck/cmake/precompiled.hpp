// Standard headers that most files include, compiled once for each target (CMake option
// LIBDECK_PRECOMPILE).
// None of the project itself: a change to one of those would compile everything again. A file
// includes what it uses all the same.
#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>
