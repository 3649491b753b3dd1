#include <cstdint>

#include "description.hpp"
#include "given.hpp"
#include "seacrane/elements/joint.hpp"
#include "seacrane/elements/loads/function_force.hpp"
#include "seacrane/math/curve.hpp"
#include "seacrane/model/description.hpp"

namespace description {

namespace {

template <class V>
constexpr bool is_rows = false;
template <int n>
constexpr bool is_rows<std::vector<Eigen::Matrix<double, n, 1>>> = true;
template <class V>
constexpr bool is_matrix = requires {
  V::ColsAtCompileTime;
};

/// What a value is called in FIELDS and in stubs, where it is given and where it is seen.
struct Words {
  const char *name, *given_as, *seen_as = "";
};
using Memory = decltype(VesselDescription::memory);
using Blocks = std::vector<StateSpaceBlock>;
using Texts = std::vector<std::string>;
using Numbers = std::vector<double>;
template <class V>
constexpr Words words_of(const V*) {
  return {"array", "numpy.typing.ArrayLike"};
}
constexpr Words words_of(const std::string*) { return {"text", "str", "str"}; }
constexpr Words words_of(const Texts*) { return {"texts", "collections.abc.Sequence[str]", "list[str]"}; }
constexpr Words words_of(const double*) { return {"number", "typing.SupportsFloat", "float"}; }
constexpr Words words_of(const bool*) { return {"flag", "bool", "bool"}; }
constexpr Words words_of(const Curve*) {
  return {"curve", "Curve | typing.SupportsFloat", "seacrane._core.Curve"};
}
constexpr Words words_of(const Frame*) { return {"frame", "Frame", "seacrane._core.Frame"}; }
constexpr Words words_of(const VesselKinematics*) { return {"text", "str", "str"}; }
constexpr Words words_of(const ForceFunction*) { return {"function", "int"}; }
constexpr Words words_of(const Numbers*) { return {"array", "numpy.typing.ArrayLike", "list[float]"}; }
constexpr Words words_of(const Blocks*) {
  return {"object", "typing.Any", "list[seacrane._core.StateSpaceBlock]"};
}
constexpr Words words_of(const Memory*) {
  return {"object", "typing.Any",
          "list[seacrane._core.StateSpaceBlock] | seacrane._core.RetardationFunctions"};
}
template <class V>
constexpr Words words = words_of(static_cast<const V*>(nullptr));

template <class V>
std::vector<int> shape_of() {
  if constexpr (std::is_same_v<V, Numbers>) {
    return {-1};
  } else if constexpr (is_rows<V>) {
    return {-1, V::value_type::RowsAtCompileTime};
  } else if constexpr (is_matrix<V>) {
    if (V::ColsAtCompileTime == 1) return {V::RowsAtCompileTime};
    return {V::RowsAtCompileTime, V::ColsAtCompileTime};
  } else {
    return {};
  }
}

using Rows = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Columns = py::array_t<double, py::array::f_style | py::array::forcecast>;  // as Eigen has them

/// As Python sees it: rows of numbers are one array.
template <class V>
py::object seen(const V& value) {
  if constexpr (is_rows<V>) {
    const auto size = static_cast<py::ssize_t>(value.size());
    return Rows({size, py::ssize_t{V::value_type::RowsAtCompileTime}},
                value.empty() ? nullptr : value[0].data());
  } else if constexpr (is_matrix<V>) {
    if (V::ColsAtCompileTime == 1) return Columns(value.rows(), value.data());
    return Columns({value.rows(), value.cols()}, value.data());
  } else if constexpr (std::is_same_v<V, VesselKinematics>) {
    return py::str(value == VesselKinematics::paper ? "paper" : "yaw_following");
  } else if constexpr (std::is_same_v<V, ForceFunction>) {
    return py::int_(reinterpret_cast<std::uintptr_t>(value));
  } else {
    return py::cast(value, py::return_value_policy::copy);
  }
}

template <class V>
std::string seen_as() {
  if constexpr (!is_rows<V> && !is_matrix<V>) return words<V>.seen_as;
  const std::vector<int> shape = shape_of<V>();
  const auto size = [](int n, const char* any) { return n < 0 ? any : std::to_string(n); };
  return "typing.Annotated[numpy.typing.NDArray[numpy.float64], \"[" + size(shape[0], "m") + ", " +
         (shape.size() == 1 ? "1" : size(shape[1], "n")) + "]\"]";
}

template <class V>
V from_python(const std::string& what, const py::object& value) {
  if constexpr (std::is_same_v<V, std::string>) {
    return given::text_of(what, value);
  } else if constexpr (std::is_same_v<V, Texts>) {
    return given::texts_of(what, value);
  } else if constexpr (std::is_same_v<V, double>) {
    return given::number_of(what, value);
  } else if constexpr (std::is_same_v<V, bool>) {
    return given::flag_of(what, value);
  } else if constexpr (std::is_same_v<V, Curve>) {
    return given::curve_of(what, value);
  } else if constexpr (std::is_same_v<V, Numbers>) {
    return given::vector_of(what, value);
  } else if constexpr (std::is_same_v<V, ForceFunction>) {
    return reinterpret_cast<V>(given::address_of(what, value));
  } else if constexpr (std::is_same_v<V, MatXd>) {
    const Columns matrix = given::matrix_of(what, value);
    return Eigen::Map<const V>(matrix.data(), matrix.shape(0), matrix.shape(1));
  } else if constexpr (is_rows<V>) {
    const Rows rows = given::rows_of(what, value, shape_of<V>()[1]);
    V out;
    for (py::ssize_t i = 0; i < rows.shape(0); ++i) out.emplace_back(rows.data(i, 0));
    return out;
  } else if constexpr (std::is_same_v<V, VesselKinematics>) {
    const std::string name = given::text_of(what, value);
    if (name == "yaw_following") return VesselKinematics::yaw_following;
    if (name == "paper") return VesselKinematics::paper;
    throw SceneError(what + " '" + name + "' is unknown; choose 'yaw_following' or 'paper'");
  } else if constexpr (std::is_same_v<V, Frame>) {
    if (py::isinstance<Frame>(value)) return value.cast<V>();
    throw SceneError(what + " is " + py::repr(value).cast<std::string>() + "; a frame is a seacrane.Frame");
  } else if constexpr (std::is_same_v<V, Memory> || std::is_same_v<V, Blocks>) {
    try {
      return value.cast<V>();
    } catch (const py::cast_error&) {
      const bool blocks = std::is_same_v<V, Blocks>;
      throw SceneError(what + " is " + py::repr(value).cast<std::string>() +
                       "; give a list of seacrane.StateSpaceBlock" +
                       (blocks ? "" : " or seacrane.RetardationFunctions"));
    }
  } else {
    const std::vector<int> shape = shape_of<V>();
    const Columns array = given::shaped_of(what, value, {shape.begin(), shape.end()});
    return V(array.data());
  }
}

}  // namespace

template <class V>
const ValueType& value_type() {
  static const ValueType out{words<V>.name,
                             words<V>.given_as,
                             seen_as<V>(),
                             shape_of<V>(),
                             [](const void* value) { return seen(*static_cast<const V*>(value)); },
                             [](void* value, const std::string& what, const py::object& given) {
                               *static_cast<V*>(value) = from_python<V>(what, given);
                             }};
  return out;
}

template const ValueType& value_type<std::string>();
template const ValueType& value_type<Texts>();
template const ValueType& value_type<double>();
template const ValueType& value_type<bool>();
template const ValueType& value_type<Curve>();
template const ValueType& value_type<Frame>();
template const ValueType& value_type<VesselKinematics>();
template const ValueType& value_type<ForceFunction>();
template const ValueType& value_type<Vec3d>();
template const ValueType& value_type<Vec4d>();
template const ValueType& value_type<Vec6d>();
template const ValueType& value_type<Mat3d>();
template const ValueType& value_type<Mat6d>();
template const ValueType& value_type<MatXd>();
template const ValueType& value_type<Numbers>();
template const ValueType& value_type<std::vector<Vec3d>>();
template const ValueType& value_type<std::vector<Vec6d>>();
template const ValueType& value_type<Blocks>();
template const ValueType& value_type<Memory>();

}  // namespace description
