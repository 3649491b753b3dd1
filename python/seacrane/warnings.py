"""Warnings, one entry for each: when it comes, then what it means and what to do.

`docs/troubleshooting.md` shows them. The class of a section silences it, or makes it an error, as a whole:
``warnings.simplefilter("error", seacrane.warnings.RunWarning)``.
"""


class SeacraneWarning(UserWarning):
    """Base of every warning that seacrane gives on purpose."""


class RunWarning(SeacraneWarning):
    """After a run, once, when its outputs show it; channels that were not recorded are not examined."""


class NearSingularWarning(RunWarning):
    """The rank changed: rows that were independent before were not enforced, as their singular value fell
    below 1e-4.

    At a dead centre or change point a mechanism can branch. Inertia carried it on, and single reactions
    there are not unique. A motion that branched off while constraints were left out is projected back when
    they are enforced again; `energy_balance` shows how much energy that took. Keep away from the position,
    or add the freedom that the real joint has.
    """


class LargeHeelWarning(RunWarning):
    """Roll or pitch beyond 20 deg.

    Restoring is linear in the angles and wave loads are those of the upright hull. Righting arms, deck in
    the water and capsize are not modelled.
    """


class MeanHeadingWarning(RunWarning):
    """The slow part of yaw (two running means over two peak periods) is more than 10 deg from the heading at
    which the wave loads of this vessel are taken.

    Use `phase="slow"` in `add_sea`, give the mean heading as `heading_deg`, or moor stiffer.
    """


class RelativePlaceWarning(RunWarning):
    """A vessel's place beside another of its group has left that of the group's data, in its slow part, by
    more than a tenth of the gap, or its heading by more than 2 deg.

    The slow part is that of two running means over two peak periods; without waves it is the mean of the run.
    Moor them closer to these places, or compute the group where they go.
    """


class MeanPositionWarning(RunWarning):
    """The slow part of the vessel's drift from where its wave loads are taken is more than 0.3 rad of the
    phase of waves at the peak.

    Use `phase="slow"` in `add_sea`, give the mean place as `position`, or moor stiffer.
    """


class ForwardSpeedWarning(RunWarning):
    """A vessel moves so fast that it meets waves at the peak 10 % faster or slower.

    The hydrodynamics of the time domain are for zero speed: added mass, damping and wave loads are wrong for
    this ship.
    """


class CurrentInWavesWarning(RunWarning):
    """A current on a vessel shifts the frequency of waves at the peak by more than 10 % between the water
    and a fixed place.

    Wave lengths are those of still water, and wave loads, added mass and damping are those without flow
    (`docs/seas.md`).
    """


class MooringTurnWarning(RunWarning):
    """Yaw passed half a turn from the rest of a mooring that is a spring in yaw.

    The spring pulls to the nearest whole turn, so it does not stop a vessel that keeps turning. Give a
    shorter `mooring_period`, or find what turns the vessel.
    """


class NoWaveLoadsWarning(RunWarning):
    """The scene has a sea, and no wave loads act on this vessel: call `add_sea` for every vessel.

    A ship that follows RAOs rests for the same reason.
    """


class MeshConvergenceWarning(RunWarning):
    """A hull was solved with half the panels too, as asked, or the mesh of a load's part, and entries of
    added mass or damping changed by more than 5 % of their largest.

    Mesh it finer: `hull.remeshed(stations=..., girth=...)`, or more `panels` of `water.from_mesh`. It also
    comes where the added mass of a part fell with depth by as much, which it cannot: often at thin walls.
    """


class MissingMotionsWarning(RunWarning):
    """The file lacks some of the six motions.

    Nothing of the water acts in them. Solve for them, or keep the vessel from them by a joint.
    """


class ModelErrorWarning(RunWarning):
    """The fit of the fluid memory errs more than the accuracy that was asked for.

    A memory by motion of a smaller limit, or `"convolution"`, errs less. Memory (`docs/memory.md`) tells how
    it is judged.
    """


class AnotherCourseWarning(RunWarning):
    """Runs of a lift in stages that differ in tolerance alone differ in their events, such as by a re-hit.

    The accuracy of curves is that of their extremes. Ask for extremes, or judge the lift over many seeds.
    """


class OutsideDatabaseWarning(RunWarning):
    """More than a fifth of the energy of a motion's velocity lies above the highest frequency of the
    database, where added mass and damping are a guess.

    Compute the database to higher frequencies, or find what shakes the vessel: usually a crane with gains
    that are too stiff.
    """


class PushingLinkWarning(RunWarning):
    """A link from which a body hangs carried compression.

    A wire would have been slack there; the snap load when it tightens is not in the result.
    `scene.add_line(joint=..., rung="rigid")` makes it one (`docs/events.md`).
    """


class LineLengthWarning(RunWarning):
    """A line starts stretched or slack by more than a hundredth of its unstretched length, so that its
    length and its points contradict each other.

    The stretch by the weight that hangs on it alone does not count. Correct one of them, or leave the length
    out: `add_line(tension_at_start=...)`. A line that is meant to start slack may keep the warning.
    """


class LineTableWarning(RunWarning):
    """A line was strained beyond the last row of its table of tension over strain, and went on along the
    last tangent.

    Extend the table.
    """


class FleetAngleWarning(RunWarning):
    """A line left the plane of a sheave's rim by more than 4 degrees.

    The path that the engine takes stays in the groove; a rope would climb out of it. Turn the sheave's axis,
    or put the sheave on a body that swivels (`docs/lines.md`).
    """


class WinchLimitWarning(RunWarning):
    """A winch hauled in to its `minimum_length` and stopped there, was commanded beyond its `maximum_rate`,
    which it keeps, or reached its `maximum_tension`, `maximum_power` or `brake_capacity`.

    Change the command or the limit. `result.events` has the instants. Before a run: its motor or brake holds
    less than what hangs on the rope, as where kN are given for N, and the load falls.
    """


class LiftedStartWarning(RunWarning):
    """Lines start by lifting a body with more than 1.5 times its weight: one of them is too short for the
    described pose. Or with more than 1.25 times what it weighs under water, where it is described: they are
    stretched by its weight in air.

    The load jumps at once, and opens its seat. Correct the length, give `tension_at_start`, or under water
    `start="rest"`.
    """


class ContactStartWarning(RunWarning):
    """A point of a contact starts inside a surface, which presses the body away at once by more than a tenth
    of its weight.

    The load is shot off. Move the body out, or correct the place of the surface.
    """


class BoilingOilWarning(RunWarning):
    """The pressure in a chamber of a hydraulic cylinder came down to `vapour_pressure`.

    The oil boils there and a void opens, which holds no load: the piston moves until the oil that flows in
    has filled it again. Let oil in (`makeup_flow`, a higher `tank_pressure`, a valve to the side that
    empties), or move slower. The events `"<name>.vapour"` and `"<name>.vapour_rod"` have the instants, and
    the channel `hydraulic_void` the volume. `refuse_void=True` ends a run there (`docs/hydraulics.md`).
    """


class NotFiniteWarning(RunWarning):
    """A channel of a finished run holds values that are not finite, and the result is kept with them.

    Leave the channel out where the scene does not define it. If it is another one, the scene has left what
    its models describe: look at what its loads do at the first such output.
    """


class UnjudgedWarning(RunWarning):
    """Something that is worked out after a run failed, such as one of the looks at its range.

    The run is kept without it, and the message says what failed and how. That is a defect of seacrane:
    please report it with the scene.
    """


class FullTurnWarning(RunWarning):
    """A recorded angle passed 180 deg and jumps there (`numpy.unwrap` joins it; `slew_angle` is joined
    already).

    Or an actuator came to be half a turn from its reference, and was driven the other way round from there.
    An angle is known to whole turns only, and the turn nearest to the reference counts. Give it a slower
    reference, or stronger gains.
    """


class OutsideRangeWarning(RunWarning):
    """A joint coordinate left the range that the scene gives it by more than 0.01 m (times `length_scale`)
    or 0.01 rad.

    For a cylinder that range is the stroke of the crane's data file. The real cylinder ends there. Correct
    the reference or the gains, or add end stops.
    """


class SoftGainsWarning(RunWarning):
    """Over the last two fifths of the outputs, the mean error of a controlled coordinate is beyond 0.25 m
    (times `length_scale`) or 5 deg.

    It is also larger than three times its variation. The stiffness is too small for the load that it
    carries, or there is none. Give `stiffness = inertia * omega**2` by `reflected_inertia`, or the load as
    `feed_forward` by `balance`. Actuators whose inputs a sampled controller sets are not examined.
    """


class LargeSwingWarning(RunWarning):
    """The load on a crane's link, or on a line that alone holds it, was more than 20 deg from vertical at an
    output.

    A load on a massless rod loses no energy by itself: it gathers what waves near its own period, and drives
    that start and stop, put in. A lift is stopped long before. Move slower, choose a link whose period is
    not the sea's, hold the load by taglines (springs to the jib), or give it the drag and the damping that
    it has (`docs/damping.md`). The tension and the cylinder forces of such a run are those of that swing.
    """


class ThroughSeatWarning(RunWarning):
    """What had left a seat (`add_stop` on a weld) came back below its plane within half a diagonal of its
    box, an event of kind "through". A seat that let go holds nothing, so the load goes on through the deck,
    where it would have hit it: what is recorded from then on is too small.

    Lift faster, or at a better moment of the heave. To see the hit itself, carry the load by a free joint
    with end stops (`docs/events.md`).
    """


class OverloadWarning(RunWarning):
    """The load is heavier than the crane's table (`[capacity]` of its data file, or `capacity` of
    `add_roles`) allows at the radius where the tip is, at some output.

    The table is of allowable loads at rest. `load_chart` tells the radii at which a load may hang, with the
    limits of the ship beside the table.
    """


class SceneWarning(SeacraneWarning):
    """Warnings of descriptions: when a scene is described, compiled or started, at your own line."""


class AssemblyWarning(SceneWarning):
    """The joints were open as described, and closing them moved a body by more than 0.01 m (times
    `length_scale`, at most 1 m) or 0.01 rad.

    The message names the bodies, and the joints and drivers that were open. Usually a driver starts at
    another value than the described pose, which is zero for a joint given by point and axis.
    `scene.report()` holds the same. Or a body was described with a velocity that its joints do not allow:
    give all bodies that move along theirs.
    """


class DriverImpulseWarning(SceneWarning):
    """A driver's curve jumps in rate during the run.

    The driven body takes an impulse: velocities jump, no recorded force shows it, and its work is in no
    energy. Join the pieces smoothly. A jump of the value itself is refused.
    """


class AngleUnitWarning(SceneWarning):
    """An angle looks like degrees where radians are due, or the other way round.

    An angle looks like degrees where radians are due, or a direction in degrees like radians.
    """


class OutsideRaosWarning(SceneWarning):
    """More than 2 % of the energy of the waves is outside the frequencies of a table of displacement RAOs
    (`docs/given-ships.md`).

    The ship moves in longer waves as in the longest of the table, and not at all in shorter ones. Give a
    table of the frequencies of the sea.
    """


class CompassDirectionWarning(SceneWarning):
    """A direction of 270 deg and more, or a wind that blows against all waves.

    Directions are where waves, wind and current go to, from +x towards +y. A compass bearing is clockwise,
    and gives where wind and waves come from. Convert it by heading - bearing + 180.
    """


class MassUnitWarning(SceneWarning):
    """A mass looks like tonnes where kilograms are due.

    A mass looks like tonnes: a payload lighter than foam, a radius of gyration above 200 m, or a body hung
    in a scene with a vessel 1e5 times heavier.
    """


class UnitWarning(SceneWarning):
    """A value is far beyond what its kind usually has, as a slip in the unit by a factor of 1000 makes it:
    kN for N, mm for m, bar for Pa, ms for s, litres for m3, a percentage for a share.

    Usual magnitudes stand with the fields of the elements (`FIELDS`, `least` and `most`); what depends on
    the rest of the scene is told as what it makes: a strain of 3.9 at rest, a piston of 100 m/s, a ship that
    heaves in 0.2 s. It comes when a run starts, that of a `MotionHistory` when it is made. If the value is
    right, filter the warning out.
    """


class NoisyMotionWarning(SceneWarning):
    """A `MotionHistory` holds accelerations at periods below 1.5 s of more than 0.3 m/s2 (rms; of angles at
    an arm of 30 m) that make a tenth of all.

    No ship moves so: it is noise of the measurement (5 mm at 10 Hz are 2 m/s2), or a time in another unit,
    or a model's time. Lines and cylinders feel it as a load. Filter the record below 0.5 Hz, in both
    directions so that its phase stays: `MotionHistory.load(path, filter_hz=0.5)` does.
    """


class DepthSignWarning(SceneWarning):
    """All points asked for are above any wave: depths were given where z, upwards, is due.

    All points at which wave kinematics were asked for are above any crest. z points up: 10 m below the water
    is z = -10.
    """


class BallastWarning(SceneWarning):
    """The weights on a vessel and the forces on it, as described, are out of balance by more than 2 deg of
    heel or trim, or 2 m of heave.

    The vessel swings from the start. Add the force that balances it (`Scene.add_ballast`), or start from
    `equilibrium`.
    """


class FreeCraneWarning(SceneWarning):
    """A crane's slew drive, or one of its cylinders or luffs, has no driver, no actuator, no other load on
    its joint, no spring beside it and no luffing rope: its jibs fall from the start.

    It was added with `held=False`, or described by hand. Without `held=False`, `add_crane` holds what nothing
    acts on; `add_driver` and `add_actuator` move it. Scenes with C functions, which may hold anything, are
    not judged.
    """


class UrdfWarning(SceneWarning):
    """A URDF file says something that is not taken over: damping or friction of a joint, or a mesh of a kind
    that is not drawn.

    Add friction by `Scene.add_friction`; convert the mesh to STL or glTF.
    """


class LoadInHullWarning(SceneWarning):
    """The load of a crane starts where the hull surely is: below the lowest joint on the vessel, above its
    keel, and within its length and breadth.

    Nothing keeps bodies apart, so the run would look well. Shorten the link, slew out before the load is
    lowered, or ignore it for a load in a moonpool. Length and breadth are those that the radii of gyration
    suggest, the keel follows from the displaced mass.
    """


class LoadOffDeckWarning(SceneWarning):
    """A load stands, by a seat or on the plane of a contact, on a body where that has no deck: beside the
    hull of a ship, or beside a body of known size.

    A seat holds wherever it is described, in the air too, and a plane has no end. Turn the crane in before
    `Scene.add_hoist` puts the load on deck, or let it hang. Length and breadth are those given, or those that
    the radii of gyration suggest; a tenth more is not told. A load more than 3 m below the lowest joint on
    the hull is a `LoadInHullWarning`.
    """


class ScatteredWavesWarning(SceneWarning):
    """A part of a load in the water (`Scene.add_immersed`) starts within a ship's breadth of her side, in a
    sea.

    Parts feel the undisturbed sea: the waves that the hull scatters, and those that it makes by moving, are
    not in it. Before a wall waves are twice as high, in a lee lower. The message tells the distance and the
    breadth, for the nearest part of each ship. Give `wave_factor` of `Scene.add_immersed`
    what the hull makes of them; vary it to bound what that does. Parts that start half a
    wave length below the surface or deeper are not judged, nor what comes near later (`docs/water.md`).
    """


class DragAxesWarning(SceneWarning):
    """A part in the water that is given by tables lies more than 45 deg on its side as described, and its
    `drag_area` along z is unlike that across.

    Drag is along the axes of a part, which turn with its body. Where the sides of the world were meant,
    give `drag_area` in the order of the part's axes, or turn the part by `axes`, so that its z axis is
    upright as it enters the water. Silence it for a load that is upended later.
    """


class StiffWarning(SceneWarning):
    """An explicit method took many steps, each about as long as it stays stable with the fastest mode.

    That mode is far faster than the outputs show: a gain, spring, line or soft stop is very stiff for the
    body that it holds. The warning names the mode and the body. Soften it, or take `rosenbrock` or
    `cvode-bdf`. Give a line that stays taut `rung="quasi-static"` (`docs/lines.md`); the warning tells
    its bound. The mode is computed only after such a run; `scene.report()` and
    `seacrane.analysis.fastest_mode` give it at any time.
    """


class GrowingModeWarning(SceneWarning):
    """Over a long run the method made an oscillation grow that has little damping of its own.

    A step h multiplies an oscillation of frequency w by R(i h w), the method's stability function. Each
    method has steps beyond which |R| exceeds one: h w of 0.47 with `tsit5`, of 0.99 with `dopri5`, of 2.5
    with `verner65`. The excess is tiny in one step, and a factor after ten thousand. Step control does not
    see it as long as the oscillation is small beside the tolerance, and `energy_balance` hardly shows it;
    standard deviations do. Most often it is a load on a long link that rocks about its own centre of mass,
    far faster than it swings: the small damping of loads (`docs/damping.md`) hardly acts on it. The warning
    tells the body, the frequency and the growth an hour. Give a smaller `rtol` (or `dt`), take `verner65` or
    `dop853`, or give the mode damping. A mode counts where it more than triples in the run. At `rtol` of
    1e-3 and looser one counts too that the method keeps ringing: a wire, say, whose oscillation steps a
    little longer would feed, until step control bounds it by the tolerance. Runs of fewer than 2,000 steps
    are not judged, nor methods without a stability polynomial (implicit, multistep), nor modes of vessels
    whose memory is a convolution. The modes are those of the linear model at rest, in the poses of start and
    end.
    """


class UnstableRestWarning(SceneWarning):
    """A scene is at rest as a pencil on its tip: the least disturbance grows.

    `equilibrium` tells which body moves most and in what time that doubles, `statics` in how many poses, and
    with which GM. `Scene.compile`, `add_ballast` and a run tell a vessel whose C44 the weights on it
    outweigh, as it is described. Most often a crane or its load is too heavy for the ship, a tank is slack,
    or taglines of constant tension turn a load away. `natural_modes(scene).table()` has a row for each
    motion that grows. Lower the weights, hold what tips over, or start the search from a state on the side
    to which it falls.
    """


class CreepingRestWarning(SceneWarning):
    """`equilibrium` leaves leakage out.

    A hydraulic cylinder that leaks creeps from where it is put, by up to what the warning tells, until its
    control makes up for it. Set its `internal_leakage` and `external_leakage` to 0, or let a run settle.
    """


class BallastOutsideHullWarning(SceneWarning):
    """`add_ballast` put its one force beyond twice the length or breadth that the ship's radii of gyration
    suggest, or you a tank beyond 1.1 times that.

    Up to there one force outside the hull stands for water on the other side; no ship has that much farther
    out. Give tanks within the hull, or ask for less heel or trim.
    """


class UnsteadyOilWarning(SceneWarning):
    """A hydraulic cylinder (`docs/hydraulics.md`) with a gain feeds a mode of what it carries: oil is a
    spring with hardly any damping, and a valve that follows the stroke faster than that spring allows swings
    on it, until the valve is open all the way.

    For one mass and a quick spool the gain is steady below 2 zeta omega over the speed of a fully open
    valve. The modes are those of the linear model in the pose of the start, with the mean of the valve's
    slopes on both sides, and are judged when the run is over. Growth of less than 0.1 % of critical damping
    is not told: the damping that loads have outweighs it. The warning tells a gain that is steady with a
    margin of two. Let `rate_gain` lead a reference that moves: 1 over the speed of the open valve. Cylinders
    without spool lag are not judged, nor the members of ensembles.
    """


class EnergyErrorWarning(SceneWarning):
    """`energy_balance` exceeds a tenth of the absolute work and of the kinetic energy.

    Most often a method of fixed step is unstable with a mode that is faster than its step allows, such as
    that of a stiff line, or `rtol` is far too loose for it. Shorten `dt`, tighten `rtol`, or take `dopri5`.
    Where the error stays, a load reports a power that does not belong to its force. `energy_limit` stops
    such runs on the way.
    """


class PushingLineWarning(SceneWarning):
    """The tension of a line with a quasi-static stretch was negative for a moment, while the line was still
    stretched: the strain follows the tension later than the line would have gone slack.

    Give it `rung="elastic"`. A line with `rung="auto"` gets a second run by itself, as for
    `LineRungWarning`.
    """


class QuasiStaticLineWarning(SceneWarning):
    """What moves the scene is so near the own frequency of a line with `rung="quasi-static"` that its
    tension errs by more than 5 %, by the estimate of `docs/lines.md`.

    Give it `rung="elastic"` or `"auto"`, or a smaller `settling`.
    """


class LineRungWarning(SceneWarning):
    """A line with `rung="auto"` was quasi-static, and went slack, or its winch hauled in to the end.

    A second run was made from the same start with elastic lines: its result is that of `rung="elastic"`, and
    the first one was lost time. Give the line that rung (`docs/lines.md`).
    """


class SeabedWarning(SceneWarning):
    """A seabed is a plane that gives and rubs, not a model of soil: nothing sinks in, sticks or flows.

    Give a stiffness from the soil's own (bearing force over settlement), vary it, and add suction at
    lift-off as a force table.
    """


class RedundantJointsWarning(SceneWarning):
    """Constraints of the named joints depend on each other, when a scene is compiled.

    Motion is unique, the reactions of these joints are not: those of least norm are given. Two hinges on one
    axis are the usual case. Where a joint's own force matters, make the other one softer or freer, such as a
    hinge and a spherical joint.
    """


class UndampedModeWarning(SceneWarning):
    """A mode within the band of the waves has no damping, or is fed, in statistics of the linear model.

    The variance of its resonance has no finite value, and it is left out around it. Give the motion damping.
    """


class SeriesWarning(SeacraneWarning):
    """Of measured series, and of runs that are compared with them."""


class FilledGapWarning(SeriesWarning):
    """Values were missing in a measured series, and `maximum_gap` let cubic splines fill them.

    The message names how many gaps, the longest and its line. A spline over an eighth of a period is right
    to some thousandths of the amplitude, over a quarter to some hundredths, over half a period it is a
    guess: cut the record there by `after` and `before`.
    """


class OutlierWarning(SeriesWarning):
    """Single samples of a measured series, or a few in a row, are far from those around them: beyond half a
    standard deviation, and five times the distance within which 95 % of all samples are.

    The message names the first five by line and column. A ship does not jump; a wire may snap. Look at them.
    `drop_outliers=True` takes them for missing values.
    """


class ClockDriftWarning(SeriesWarning):
    """The clock of a measured series gains or loses more than a sample over the record, on a second clock in
    its file or on the number of its samples at the rate that was given as `rate_hz`.

    Phases and shifts are wrong by as much. Take the clock that is right, or correct the times.
    """


class UncertainShiftWarning(SeriesWarning):
    """`compare` found a shift in time that the two curves do not tell for sure: their correlation there is
    below 0.5, or it still grows at the longest shift that was looked at, or another shift is as good.

    The message says which. Curves of one period fit again after each. Give a smaller `maximum_shift`, or 0
    where both have the same clock.
    """


class SeaWarning(SeacraneWarning):
    """Warnings of seas, and of the ensembles and statistics of what happens in them."""


class SteepSeaWarning(SeaWarning):
    """The sea is steeper than the limit that DNV-RP-C205 gives: its waves break, and linear ones overstate
    crests.

    Lower `hs` or lengthen `tp`.
    """


class RepeatingSeaWarning(SeaWarning):
    """The run is longer than the period of its sea, which was made by FFT. What comes later adds nothing to
    extremes.

    Take more components in the same band.
    """


class AccuracyNotHeldWarning(SeaWarning):
    """`ensemble(accuracy=...)` chose its method by a few members, and one that was checked afterwards has a
    larger error.

    The message names it. Give the `rtol` that it proposes, or probe the worst members by
    `simulate(accuracy=...)`.
    """


class LostMembersWarning(SeaWarning):
    """Members that were in the store of an ensemble cannot be read: a power loss, a full disk or another
    program took a chunk or a pack.

    They are run again, and nothing else is to be done. Where it comes again, look at the disk.
    """


class FailedMembersWarning(SeaWarning):
    """Members of an ensemble failed, some or all: its dataset holds nothing of them.

    The message gives how many and the first failure, `Ensemble.failures` all. Where all fail it is most often
    a function of `keep` that raises, or a name that no result has: try it on one result of `simulate`. Where
    some do, it may be those that load the lift most: what is kept of the others says too little.
    """


class FailedSeedsWarning(SeaWarning):
    """Seeds of an ensemble with `until` failed.

    A lift may fail just in the seas that load it most, so the interval allows for whatever they would have
    given, and there is none where too many failed: the message names the statistic and the first failure,
    `Ensemble.failures` all. Mend what fails, in the lift or in its numbers.
    """


class FewSeedsWarning(SeaWarning):
    """The 95 % interval of a largest value is wider than `half_width` asked, or there are fewer than ten
    seeds.

    Run more: the message tells about how many (`docs/statistics.md`).
    """


class StartTransientWarning(SeaWarning):
    """Mean or standard deviation of the first fifth of a record differ from the rest by more than chance.

    The start is part of the statistics: leave it out with `start=`.
    """


class PoorFitWarning(SeaWarning):
    """The tail fitted to peaks, or Gumbel's distribution fitted to maxima, does not describe them.

    Look at `plot_extremes`. Take another `threshold` or `tail`, the empirical numbers, or more seeds.
    """


class WavesWithoutLoadWarning(SeaWarning):
    """More than 2 % of the variance of a load on a vessel belongs to waves above the frequencies of its
    database, which put no load on it (`docs/hydrodynamics.md`).

    The figure is an estimate. Compute the database to higher frequencies: three times the sea's peak holds
    nearly all. Elevation, flow and other vessels have these waves.
    """


class BlockedWavesWarning(SeaWarning):
    """Waves that come against the current faster than they can travel on it are left out of the sea.

    In deep water those are beyond a frequency of g / (4 U). Real ones break before. Give a lower
    `maximum_omega`, or a spectrum measured on that current.
    """


class SecondOrderFlowWarning(SeaWarning):
    """Waves are so steep that linear theory, which leaves (u . grad) u out, is off by a third or more in the
    acceleration of the water near its surface.

    The figure is an estimate from standard deviations in deep water. Look deeper down, or take such loads as
    an estimate.
    """


class RaoPhaseWarning(SeaWarning):
    """Waves far longer than a hull carry it along: it heaves with the crest and pitches with the slope,
    whatever it is.

    Here heave and pitch in the longest wave have those amplitudes, and a phase of more than 60 deg from it.
    With the signs of lags where leads are due, give the complex conjugate. Phases in degrees take
    `numpy.radians`. Else the origin of the phases or an axis is another one (`docs/conventions.md`,
    `docs/given-ships.md`). Tables that begin at waves which the hull does not follow are not judged.
    """


class WaterMismatchWarning(SeaWarning):
    """Density, gravity, depth or units of two sources differ.

    Give both the same.
    """


class HeadingGapWarning(SeaWarning):
    """Headings of a database leave more than 45 deg open: a sea from there is refused.

    Compute the missing ones.
    """


class VesselWarning(SeacraneWarning):
    """Warnings of vessels and their fluid memory."""


class RollDampingWarning(VesselWarning):
    """No roll damping beside radiation: roll at resonance has no converged answer.

    Give the viscous part.
    """


class DampingWarning(VesselWarning):
    """Negative damping: a motion gains energy from still water.

    Correct the sign, or narrow `trusted_band`.
    """


class AsymmetryWarning(VesselWarning):
    """Added mass or damping of a hull at rest is not symmetric, as half a matrix is, or one with an entry in
    the wrong place.

    Motions that it couples are off by as much. Give both halves, or the mean of both.
    """


class DoubleCountedDampingWarning(VesselWarning):
    """A current load and the vessel's own viscous damping both slow the same motion.

    Set one to zero.
    """


class BelowBandWarning(VesselWarning):
    """A vessel resonates, or a sea has more than a tenth of its energy, below the trusted band of the
    database.

    Strip theory radiates too much there (`docs/hull-hydrodynamics.md`). Take a database of the panel method,
    or one that covers these frequencies.
    """


class OwnMooringWarning(VesselWarning):
    """The restoring of a database holds stiffness in surge, sway or yaw: a mooring, which is used in place
    of the usual 200 s.

    Take `database.without_mooring()` to give another one (`docs/hydrodynamics.md`).
    """


class QuadraticDampingWarning(VesselWarning):
    """Quadratic damping of a translation does not move with the reference point; its coupling is lost.

    State it about the new point.
    """


class MemoryFitWarning(VesselWarning):
    """The memory model does not reach the agreement asked for, or the usual 1 % of the motions.

    The message gives the motion, the best that was reached and what stops it: often data that contradict
    themselves, or too few of them. Narrow the database's `trusted_band`, accept the number by a larger
    limit, `dataclasses.replace(database, memory=fit_memory(database=database, limit=0.03))`, or take
    `memory="convolution"` where the message says that it errs less.
    """


class MemoryMismatchWarning(VesselWarning):
    """The memory belongs to other data: another ship, point or loading.

    Fit it to this database.
    """


class NonPassiveMemoryWarning(VesselWarning):
    """The memory can feed energy into a motion, which may then grow out of nothing.

    Use `memory="by-motion"`, the default.
    """


class InfiniteFrequencyWarning(VesselWarning):
    """No infinite-frequency added mass to compare the estimate with.

    Compute it, or extend the frequencies.
    """


class SourceWarning(SeacraneWarning):
    """Warnings of files and hulls: what a source does not say, and what was taken in its place."""


class AssumedDensityWarning(SourceWarning):
    """The file names no water density: 1025 kg/m3 was taken.

    Give it.
    """


class AssumedInertiaWarning(SourceWarning):
    """The file holds no mass matrix: displaced mass and usual radii of gyration were taken.

    Give the vessel's own.
    """


class AssumedReferenceWarning(SourceWarning):
    """The file does not tell about which points its bodies turn: the origin of the meshes was taken.

    Give the points, as `read_capytaine(rotation_centre=...)` takes them, of several bodies by name.
    """


class RoundedPhaseWarning(SourceWarning):
    """Wave forces were read from a listing that rounds their phases to degrees.

    Give the files of numbers beside it.
    """


class AssumedSymmetryWarning(SourceWarning):
    """The file does not state its symmetry.

    State it, or compute all headings.
    """


class RoughDataWarning(SourceWarning):
    """The matrices of a file that does not tell its panels jump from a frequency on, and its trusted band
    ends below (`docs/hydrodynamics.md`).

    Solve with finer panels or with a lid against irregular frequencies, or give `load_database(path,
    trusted_band=(low, high))`.
    """


class PartialSetWarning(SourceWarning):
    """Files of one set cover different periods, headings or speeds: only the common ones were read.

    Compute the set again.
    """


class SeveralSpeedsWarning(SourceWarning):
    """Several forward speeds and none chosen.

    Choose by `speed=`.
    """


class EncounterFrequencyWarning(SourceWarning):
    """Matrices at forward speed are not one function of encounter frequency: use zero speed, or one heading.

    Or more than a tenth of the energy of the waves is met outside the table of a database at speed: see
    `docs/frequency-domain.md`.
    """


class HydrostaticsWarning(SourceWarning):
    """Hydrostatics contradict the matrices: one of them is of another loading.

    Use files of one run.
    """


class FloatingPositionWarning(SourceWarning):
    """The hull would not float as drawn with this mass and centre of gravity, or turns over by itself.

    Correct draught, mass or centre, or add what keeps it upright.
    """


class SubmergedPartWarning(SourceWarning):
    """A part of the hull hangs under water apart from the rest, and strip theory leaves it out.

    Use panels.
    """
