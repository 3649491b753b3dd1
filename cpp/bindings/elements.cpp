#include "bindings.hpp"
#include "seacrane/model/description.hpp"

using namespace seacrane;

namespace {

template <class T>
using Class = py::class_<T>;

void bind_body(py::module_& m) {
  using D = BodyDescription;
  Class<D>(m, "Body",
           "A rigid body: inertia (3, 3) in kg m2 about the centre of mass in body axes, pose of the body "
           "origin in the inertial frame, quaternion (w, x, y, z) body to inertial. Immutable.")
      .def(py::init([](std::string name, double mass, Mat3d inertia, Vec3d com, Vec3d position,
                       Vec4d quaternion, Vec3d velocity, Vec3d angular_velocity, bool gravity) {
             return D{std::move(name), mass,     inertia,          com,    position,
                      quaternion,      velocity, angular_velocity, gravity};
           }),
           py::kw_only(), py::arg("name"), py::arg("mass"), py::arg("inertia"),
           py::arg("center_of_mass") = Vec3d(0, 0, 0), py::arg("position") = Vec3d(0, 0, 0),
           py::arg("quaternion") = Vec4d(1, 0, 0, 0), py::arg("velocity") = Vec3d(0, 0, 0),
           py::arg("angular_velocity") = Vec3d(0, 0, 0), py::arg("gravity") = true)
      .def_property_readonly("name", [](const D& d) { return d.name; })
      .def_property_readonly(
          "mass", [](const D& d) { return d.mass; }, "kg")
      .def_property_readonly(
          "inertia", [](const D& d) { return d.inertia; }, "kg m2, about the centre of mass (copy)")
      .def_property_readonly(
          "center_of_mass", [](const D& d) { return d.center_of_mass; }, "m, body axes (copy)")
      .def_property_readonly(
          "position", [](const D& d) { return d.position; }, "m, inertial frame (copy)")
      .def_property_readonly(
          "quaternion", [](const D& d) { return d.quaternion; }, "w, x, y, z (copy)")
      .def_property_readonly(
          "velocity", [](const D& d) { return d.velocity; }, "m/s, inertial frame (copy)")
      .def_property_readonly(
          "angular_velocity", [](const D& d) { return d.angular_velocity; }, "rad/s (copy)")
      .def_property_readonly(
          "gravity", [](const D& d) { return d.gravity; }, "whether weight acts on it");
}

void bind_joint(py::module_& m) {
  Class<Frame>(
      m, "Frame",
      "A joint frame: a point (m) and axes (3, 3, columns; z is the joint axis) in body coordinates.")
      .def(py::init([](Vec3d point, Mat3d axes) {
             return Frame{point, axes};
           }),
           py::kw_only(), py::arg("point") = Vec3d(0, 0, 0), py::arg("axes") = Mat3d(Mat3d::Identity()))
      .def_property_readonly("point", [](const Frame& d) { return d.point; })
      .def_property_readonly("axes", [](const Frame& d) { return d.axes; });
  using D = JointDescription;
  Class<D>(m, "Joint",
           "A joint between two bodies ('ground' is the inertial frame); may close a loop. Kinds: weld, "
           "revolute, prismatic, cylindrical, universal, spherical, planar, distance, free.")
      .def(py::init([](std::string name, std::string kind, std::string first, std::string second, Frame a,
                       Frame b, double length) {
             return D{std::move(name), std::move(kind), std::move(first), std::move(second), a, b, length};
           }),
           py::kw_only(), py::arg("name"), py::arg("kind"), py::arg("first"), py::arg("second"),
           py::arg("first_frame"), py::arg("second_frame"), py::arg("length") = 0.0)
      .def_property_readonly("name", [](const D& d) { return d.name; })
      .def_property_readonly("kind", [](const D& d) { return d.kind; })
      .def_property_readonly("first", [](const D& d) { return d.first; })
      .def_property_readonly("second", [](const D& d) { return d.second; })
      .def_property_readonly("first_frame", [](const D& d) { return d.first_frame; })
      .def_property_readonly("second_frame", [](const D& d) { return d.second_frame; })
      .def_property_readonly(
          "length", [](const D& d) { return d.length; }, "m, distance joints");
}

void bind_drives(py::module_& m) {
  Class<DriverDescription>(m, "Driver", "Prescribes a joint coordinate (m or rad) as a function of time.")
      .def(py::init([](std::string name, std::string joint, std::string coordinate, Curve curve) {
             return DriverDescription{
                 std::move(name), {std::move(joint), std::move(coordinate)}, std::move(curve)};
           }),
           py::kw_only(), py::arg("name"), py::arg("joint"), py::arg("coordinate"), py::arg("curve"))
      .def_property_readonly("name", [](const DriverDescription& d) { return d.name; })
      .def_property_readonly("joint", [](const DriverDescription& d) { return d.coordinate.joint; })
      .def_property_readonly("coordinate", [](const DriverDescription& d) { return d.coordinate.coordinate; })
      .def_property_readonly("curve", [](const DriverDescription& d) { return d.curve; });
  using A = ActuatorDescription;
  Class<A>(m, "Actuator",
           "State feedback on a joint coordinate q: feed_forward + stiffness (reference - q) + damping "
           "(reference rate - q rate), N (N/m, N s/m) or N m (N m/rad, N m s/rad).")
      .def(py::init([](std::string name, std::string joint, std::string coordinate, double stiffness,
                       double damping, Curve feed_forward, Curve reference) {
             return A{std::move(name),
                      {std::move(joint), std::move(coordinate)},
                      stiffness,
                      damping,
                      std::move(feed_forward),
                      std::move(reference)};
           }),
           py::kw_only(), py::arg("name"), py::arg("joint"), py::arg("coordinate"),
           py::arg("stiffness") = 0.0, py::arg("damping") = 0.0,
           py::arg_v("feed_forward", Curve::constant(0.0), "Curve.constant(value=0.0)"),
           py::arg_v("reference", Curve::constant(0.0), "Curve.constant(value=0.0)"))
      .def_property_readonly("name", [](const A& d) { return d.name; })
      .def_property_readonly("joint", [](const A& d) { return d.coordinate.joint; })
      .def_property_readonly("coordinate", [](const A& d) { return d.coordinate.coordinate; })
      .def_property_readonly("stiffness", [](const A& d) { return d.stiffness; })
      .def_property_readonly("damping", [](const A& d) { return d.damping; })
      .def_property_readonly("feed_forward", [](const A& d) { return d.feed_forward; })
      .def_property_readonly("reference", [](const A& d) { return d.reference; });
}

void bind_loads(py::module_& m) {
  using P = PointForceDescription;
  Class<P>(m, "PointForce",
           "A constant force (N) at a body-fixed point (m, body coordinates), in inertial or body axes.")
      .def(py::init([](std::string name, std::string body, Vec3d point, Vec3d force, bool body_axes) {
             return P{std::move(name), std::move(body), point, force, body_axes};
           }),
           py::kw_only(), py::arg("name"), py::arg("body"), py::arg("point"), py::arg("force"),
           py::arg("body_axes") = false)
      .def_property_readonly("name", [](const P& d) { return d.name; })
      .def_property_readonly("body", [](const P& d) { return d.body; })
      .def_property_readonly("point", [](const P& d) { return d.point; })
      .def_property_readonly("force", [](const P& d) { return d.force; })
      .def_property_readonly("body_axes", [](const P& d) { return d.body_axes; });
  using S = SpringDescription;
  Class<S>(m, "Spring",
           "Tension between two body-fixed points: stiffness (N/m) times elongation, or a table of tension "
           "(N) over length (m), plus damping (N s/m) times the rate of length.")
      .def(py::init([](std::string name, std::string first, std::string second, Vec3d a, Vec3d b,
                       double stiffness, double damping, double natural_length, std::vector<double> lengths,
                       std::vector<double> forces) {
             return S{std::move(name), std::move(first),   std::move(second), a, b, stiffness, damping,
                      natural_length,  std::move(lengths), std::move(forces)};
           }),
           py::kw_only(), py::arg("name"), py::arg("first"), py::arg("second"), py::arg("first_point"),
           py::arg("second_point"), py::arg("stiffness") = 0.0, py::arg("damping") = 0.0,
           py::arg("natural_length") = 0.0, py::arg("lengths") = std::vector<double>{},
           py::arg("forces") = std::vector<double>{})
      .def_property_readonly("name", [](const S& d) { return d.name; })
      .def_property_readonly("first", [](const S& d) { return d.first; })
      .def_property_readonly("second", [](const S& d) { return d.second; })
      .def_property_readonly("first_point", [](const S& d) { return d.first_point; })
      .def_property_readonly("second_point", [](const S& d) { return d.second_point; })
      .def_property_readonly("stiffness", [](const S& d) { return d.stiffness; })
      .def_property_readonly("damping", [](const S& d) { return d.damping; })
      .def_property_readonly("natural_length", [](const S& d) { return d.natural_length; })
      .def_property_readonly("lengths", [](const S& d) { return d.lengths; })
      .def_property_readonly("forces", [](const S& d) { return d.forces; });
  using F = ForceTableDescription;
  Class<F>(
      m, "ForceTable",
      "Force and moment (n, 6), N and N m, inertial axes, about a body-fixed point, over times (n,) in s; "
      "linear in between, held outside.")
      .def(py::init([](std::string name, std::string body, Vec3d point, std::vector<double> times,
                       const Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>& wrenches) {
             std::vector<Vec6d> rows;
             for (Eigen::Index i = 0; i < wrenches.rows(); ++i)
               rows.emplace_back(wrenches.row(i).transpose());
             return F{std::move(name), std::move(body), point, std::move(times), std::move(rows)};
           }),
           py::kw_only(), py::arg("name"), py::arg("body"), py::arg("point"), py::arg("times"),
           py::arg("wrenches"))
      .def_property_readonly("name", [](const F& d) { return d.name; })
      .def_property_readonly("body", [](const F& d) { return d.body; })
      .def_property_readonly("point", [](const F& d) { return d.point; })
      .def_property_readonly("times", [](const F& d) { return d.times; })
      .def_property_readonly("wrenches", [](const F& d) {
        MatXd rows(static_cast<Eigen::Index>(d.wrenches.size()), 6);
        for (std::size_t i = 0; i < d.wrenches.size(); ++i) {
          rows.row(static_cast<Eigen::Index>(i)) = d.wrenches[i].transpose();
        }
        return rows;
      });
  using U = FunctionForceDescription;
  Class<U>(m, "FunctionForce",
           "A C function called in every evaluation, by its address (numba.cfunc(...).address): void "
           "f(double t, const double* state13, const double* parameters, double* wrench6); state: "
           "position, quaternion, velocity, angular velocity of the body origin; inertial axes.")
      .def(py::init([](std::string name, std::string body, std::uintptr_t address,
                       std::vector<double> parameters) {
             return U{std::move(name), std::move(body), reinterpret_cast<ForceFunction>(address),
                      std::move(parameters)};
           }),
           py::kw_only(), py::arg("name"), py::arg("body"), py::arg("address"),
           py::arg("parameters") = std::vector<double>{})
      .def_property_readonly("name", [](const U& d) { return d.name; })
      .def_property_readonly("body", [](const U& d) { return d.body; });
}

void bind_retardation(py::module_& m) {
  using R = RetardationFunctions;
  using Samples = py::array_t<double, py::array::c_style | py::array::forcecast>;
  Class<R>(
      m, "RetardationFunctions",
      "Fluid memory by direct convolution, mu_j(t) = sum_k integral K_jk(tau) v_k(t - tau) dtau: kernel "
      "(n, 6, 6) at tau = 0, step, 2 step ... in s, cubic in between, zero beyond. Motions 0 (surge) ... "
      "5 (yaw); the motion is sampled at the same step.")
      .def(py::init([](double step, const Samples& kernel) {
             if (kernel.ndim() != 3 || kernel.shape(1) != 6 || kernel.shape(2) != 6) {
               throw std::invalid_argument("retardation functions: the kernel must have shape (n, 6, 6)");
             }
             R out{step, std::vector<Mat6d>(static_cast<std::size_t>(kernel.shape(0)))};
             const double* at = kernel.data();
             for (Mat6d& sample : out.kernel) {
               sample = Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(at);
               at += 36;
             }
             return out;
           }),
           py::kw_only(), py::arg("step"), py::arg("kernel"))
      .def_property_readonly(
          "step", [](const R& r) { return r.step; }, "s")
      .def_property_readonly(
          "kernel",
          [](const R& r) {
            Samples out({static_cast<py::ssize_t>(r.kernel.size()), py::ssize_t{6}, py::ssize_t{6}});
            double* at = out.mutable_data();
            for (const Mat6d& sample : r.kernel) {
              Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>{at} = sample;
              at += 36;
            }
            return out;
          },
          "(n, 6, 6), N and N m per m/s and rad/s and s, copy");
}

void bind_vessel(py::module_& m) {
  using B = StateSpaceBlock;
  Class<B>(
      m, "StateSpaceBlock",
      "Fluid memory x' = A x + B u, mu = C x + D u between motions 0 (surge) ... 5 (yaw), eqs (29)-(30).")
      .def(py::init([](std::vector<int> inputs, std::vector<int> outputs, MatXd a, MatXd b, MatXd c, MatXd d,
                       VecXd state_scale) {
             return B{std::move(inputs), std::move(outputs), std::move(a),          std::move(b),
                      std::move(c),      std::move(d),       std::move(state_scale)};
           }),
           py::kw_only(), py::arg("inputs"), py::arg("outputs"), py::arg("a"), py::arg("b"), py::arg("c"),
           py::arg("d"), py::arg("state_scale") = VecXd())
      .def_property_readonly("inputs", [](const B& x) { return x.inputs; })
      .def_property_readonly("outputs", [](const B& x) { return x.outputs; })
      .def_property_readonly("a", [](const B& x) { return x.a; })
      .def_property_readonly("b", [](const B& x) { return x.b; })
      .def_property_readonly("c", [](const B& x) { return x.c; })
      .def_property_readonly("d", [](const B& x) { return x.d; })
      .def_property_readonly("state_scale", [](const B& x) { return x.state_scale; });
  bind_retardation(m);
  using V = VesselDescription;
  Class<V>(m, "VesselHydrodynamics",
           "Linear hydrodynamics of a body about its origin (the reference point): added mass, damping and "
           "restoring "
           "(6, 6), quadratic damping (6,), mooring stiffness and damping of surge, sway, yaw (3,), memory "
           "blocks or retardation functions. "
           "kinematics: 'yaw_following' (default) or 'paper', eqs (17)-(31).")
      .def(py::init([](std::string name, std::string body, Mat6d added_mass, Mat6d linear_damping,
                       Vec6d quadratic, Mat6d restoring, Vec3d mooring_stiffness, Vec3d mooring_damping,
                       std::variant<std::vector<B>, RetardationFunctions> memory,
                       const std::string& kinematics) {
             if (kinematics != "yaw_following" && kinematics != "paper") {
               throw std::invalid_argument("vessel '" + name + "': kinematics '" + kinematics +
                                           "' is unknown; choose 'yaw_following' or 'paper'");
             }
             return V{std::move(name),
                      std::move(body),
                      added_mass,
                      linear_damping,
                      quadratic,
                      restoring,
                      mooring_stiffness,
                      mooring_damping,
                      std::move(memory),
                      kinematics == "paper" ? VesselKinematics::paper : VesselKinematics::yaw_following};
           }),
           py::kw_only(), py::arg("name"), py::arg("body"), py::arg("added_mass") = Mat6d(Mat6d::Zero()),
           py::arg("linear_damping") = Mat6d(Mat6d::Zero()),
           py::arg("quadratic_damping") = Vec6d(Vec6d::Zero()), py::arg("restoring") = Mat6d(Mat6d::Zero()),
           py::arg("mooring_stiffness") = Vec3d(0, 0, 0), py::arg("mooring_damping") = Vec3d(0, 0, 0),
           py::arg("memory") = std::vector<B>{}, py::arg("kinematics") = "yaw_following")
      .def_property_readonly("name", [](const V& v) { return v.name; })
      .def_property_readonly("body", [](const V& v) { return v.body; })
      .def_property_readonly("added_mass", [](const V& v) { return v.added_mass; })
      .def_property_readonly("linear_damping", [](const V& v) { return v.linear_damping; })
      .def_property_readonly("quadratic_damping", [](const V& v) { return v.quadratic_damping; })
      .def_property_readonly("restoring", [](const V& v) { return v.restoring; })
      .def_property_readonly("mooring_stiffness", [](const V& v) { return v.mooring_stiffness; })
      .def_property_readonly("mooring_damping", [](const V& v) { return v.mooring_damping; })
      .def_property_readonly("memory", [](const V& v) { return v.memory; })
      .def_property_readonly("kinematics", [](const V& v) {
        return v.kinematics == VesselKinematics::paper ? "paper" : "yaw_following";
      });
}

}  // namespace

void bind_elements(py::module_& m) {
  bind_body(m);
  bind_joint(m);
  bind_drives(m);
  bind_loads(m);
  bind_vessel(m);
  bind_flow_force(m);
  bind_limits(m);
}
