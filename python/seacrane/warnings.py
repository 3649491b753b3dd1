"""Warnings."""


class SeacraneWarning(UserWarning):
    """Base of every warning that seacrane gives on purpose."""


class RunWarning(SeacraneWarning):
    """Warnings after a run."""


class NearSingularWarning(RunWarning):
    """Constraints came to depend on each other: the mechanism could branch, and reactions are not unique."""


class LargeHeelWarning(RunWarning):
    """Roll or pitch beyond 20 deg: the linear restoring and the wave loads are those of an upright hull."""


class MeanHeadingWarning(RunWarning):
    """A vessel turned away from the heading at which its wave loads are taken."""


class MeanPositionWarning(RunWarning):
    """A vessel drifted away from where its wave loads are taken: their phase is that of another place."""


class ForwardSpeedWarning(RunWarning):
    """A vessel makes way through waves, and its hydrodynamics are those of zero speed."""


class CurrentInWavesWarning(RunWarning):
    """A current is strong enough to change the waves that a vessel meets, and its loads do not know it."""


class MooringTurnWarning(RunWarning):
    """A vessel turned beyond half a turn, where a mooring that is a spring in yaw pulls the other way."""


class NoWaveLoadsWarning(RunWarning):
    """A vessel is in a sea that does not load it."""


class MeshConvergenceWarning(RunWarning):
    """Added mass or damping changes by more than 5 % of its largest with half the panels."""


class MissingMotionsWarning(RunWarning):
    """The source lacks some of the six motions: nothing of the water acts in them."""


class ModelErrorWarning(RunWarning):
    """The fit of the fluid memory leaves a larger error than the accuracy asked of the integration."""


class OutsideDatabaseWarning(RunWarning):
    """A vessel moves at frequencies that its database does not hold: its fluid memory there is a guess."""


class PushingLinkWarning(RunWarning):
    """A link of constant length pushed: a wire would have gone slack, and snapped tight later."""


class LineLengthWarning(RunWarning):
    """A line starts far longer or shorter than its path: its length or a point is not what was meant."""


class LineTableWarning(RunWarning):
    """A line was strained beyond the table of its tension, which goes on along its last tangent."""


class FleetAngleWarning(RunWarning):
    """A line leaves a sheave at an angle at which ropes do not stay in their groove."""


class WinchLimitWarning(RunWarning):
    """A winch met a limit: it did not do what it was commanded."""


class LiftedStartWarning(RunWarning):
    """Lines start by lifting a body with far more than its weight: one of them is too short."""


class BoilingOilWarning(RunWarning):
    """The oil of a hydraulic cylinder boiled: a void opened, which holds no load and closes with a knock."""


class NotFiniteWarning(RunWarning):
    """A channel of a finished run holds values that are no numbers."""


class UnjudgedWarning(RunWarning):
    """Something that is worked out after a run failed, and is missing; what was recorded is whole."""


class FullTurnWarning(RunWarning):
    """An angle passed half a turn: its record jumps there, and so does the error an actuator sees."""


class OutsideRangeWarning(RunWarning):
    """A coordinate left its range, such as a cylinder the stroke of the crane's data file."""


class SoftGainsWarning(RunWarning):
    """An actuator stays away from its reference: gains too soft for what it carries, or no feed-forward."""


class LargeSwingWarning(RunWarning):
    """A load on a crane's link, or on one line alone, swung beyond 20 deg: further than any lift is let."""


class ThroughSeatWarning(RunWarning):
    """What had left a seat went below its plane again: nothing stops it there, where a deck would."""


class OverloadWarning(RunWarning):
    """The load of a crane is above what the crane's own table allows at the radius where it is."""


class SceneWarning(SeacraneWarning):
    """Warnings of descriptions."""


class AssemblyWarning(SceneWarning):
    """Closing the joints moved bodies from where they were described, or changed a described velocity."""


class DriverImpulseWarning(SceneWarning):
    """A driver's rate jumps: what it drives takes an impulse, whose work is in no energy."""


class RenamedKeysWarning(SceneWarning):
    """A lift or study file has keys that are called otherwise since 0.3."""


class AngleUnitWarning(SceneWarning):
    """An angle looks like degrees where radians are due, or the other way round."""


class OutsideRaosWarning(SceneWarning):
    """Waves are longer or shorter than those of a table of RAOs, which says nothing of them."""


class CompassDirectionWarning(SceneWarning):
    """A direction looks like a compass bearing, clockwise and where it comes from."""


class MassUnitWarning(SceneWarning):
    """A mass looks like tonnes where kilograms are due."""


class UnitWarning(SceneWarning):
    """A value is far beyond what its kind usually has: a slip in its unit, by a factor of 1000 or so."""


class NoisyMotionWarning(SceneWarning):
    """A measured motion holds accelerations that no ship has: noise, or a time in another unit."""


class DepthSignWarning(SceneWarning):
    """All points asked for are above any wave: depths were given where z, upwards, is due."""


class BallastWarning(SceneWarning):
    """A vessel starts far from where its weights balance: ballast is missing, or misplaced."""


class FreeCraneWarning(SceneWarning):
    """A crane's slew drive, cylinder or luff has no driver and no actuator: its jibs fall."""


class UrdfWarning(SceneWarning):
    """A URDF file says something that is not taken over: friction of a joint, a mesh of another kind."""


class LoadInHullWarning(SceneWarning):
    """The load of a crane starts inside the hull of a vessel, through which it hangs."""


class StiffWarning(SceneWarning):
    """One mode is so fast that an explicit method takes short steps for it alone."""


class GrowingModeWarning(SceneWarning):
    """The method made an oscillation with little damping grow over a long run, or kept it ringing."""


class UnstableRestWarning(SceneWarning):
    """A state of rest at which the scene does not stay: the least disturbance grows."""


class CreepingRestWarning(SceneWarning):
    """A state of rest from which something creeps, as a hydraulic cylinder that leaks."""


class BallastOutsideHullWarning(SceneWarning):
    """Ballast was put where the ship has no room for it."""


class UnsteadyOilWarning(SceneWarning):
    """The gain of a hydraulic cylinder is so high that its load swings with a growing amplitude."""


class EnergyErrorWarning(SceneWarning):
    """The energy balance does not close by far: the step is too long, or a load tells a wrong power."""


class PushingLineWarning(SceneWarning):
    """A quasi-static line pushed for a moment while it was stretched; an elastic one would be slack."""


class QuasiStaticLineWarning(SceneWarning):
    """What moves a scene is too near the frequency of a line that is given as quasi-static."""


class LineRungWarning(SceneWarning):
    """A line with rung "auto" went slack as quasi-static: a second run, with elastic lines, was made."""


class SeaWarning(SeacraneWarning):
    """Warnings of seas."""


class SteepSeaWarning(SeaWarning):
    """A sea is steeper than any that stands: its waves break, and linear waves overstate crests and loads."""


class RepeatingSeaWarning(SeaWarning):
    """A run is longer than its sea: after one period it meets the same waves, and extremes learn nothing."""


class AccuracyNotHeldWarning(SeaWarning):
    """A member that was checked has a larger error than `accuracy` allows: probes were milder than it."""


class LostMembersWarning(SeaWarning):
    """Members that were in a store are lost or damaged, and are run again."""


class FailedSeedsWarning(SeaWarning):
    """Seeds failed: what they would have given is not known, and an interval must allow for it."""


class FewSeedsWarning(SeaWarning):
    """Too few seeds for the number asked: its interval is wider than asked, or nobody can tell."""


class StartTransientWarning(SeaWarning):
    """The first fifth of a record differs from the rest: the start is part of the statistics."""


class PoorFitWarning(SeaWarning):
    """The distribution fitted to peaks or maxima does not describe them."""


class WavesWithoutLoadWarning(SeaWarning):
    """Waves above the frequencies of a database carry no load that matters: motions come out too small."""


class RaoPhaseWarning(SeaWarning):
    """Motions in the longest wave do not have the phase that every hull has there."""


class WaterMismatchWarning(SeaWarning):
    """Density, gravity or depth of two sources differ: weights, buoyancy or wave lengths do not fit."""


class HeadingGapWarning(SeaWarning):
    """Headings do not close the circle: seas from within the gap are refused."""


class VesselWarning(SeacraneWarning):
    """Warnings of vessels and their memory."""


class RollDampingWarning(VesselWarning):
    """The vessel has no roll damping beside radiation: its roll at resonance has no converged answer."""


class DampingWarning(VesselWarning):
    """Damping is negative: a motion gains energy from still water, and may grow."""


class DoubleCountedDampingWarning(VesselWarning):
    """Current coefficients and damping of the vessel both slow its drift: its motions come out too small."""


class BelowBandWarning(VesselWarning):
    """A database is used below its trusted band: damping there, and what resonates, is far off."""


class OwnMooringWarning(VesselWarning):
    """The database's restoring holds a mooring, which is used."""


class QuadraticDampingWarning(VesselWarning):
    """Quadratic damping of a translation does not move with the reference point: its coupling is lost."""


class MemoryFitWarning(VesselWarning):
    """A memory model does not follow the data as closely as was asked."""


class MemoryMismatchWarning(VesselWarning):
    """A memory model of other data: radiation loads belong to another ship, point or loading."""


class NonPassiveMemoryWarning(VesselWarning):
    """A memory model can feed energy into a motion: motions may grow out of nothing."""


class InfiniteFrequencyWarning(VesselWarning):
    """No infinite-frequency added mass to compare with: an error of its estimate is a wrong mass always."""


class SourceWarning(SeacraneWarning):
    """Warnings of readers and hulls."""


class AssumedDensityWarning(SourceWarning):
    """The source holds no water density: 1025 kg/m3 scales every mass, stiffness and force."""


class AssumedInertiaWarning(SourceWarning):
    """The source holds no mass matrix: displaced mass and usual radii of gyration decide the motions."""


class AssumedSymmetryWarning(SourceWarning):
    """The source does not name its symmetry: loads from the other side, or none, follow from a guess."""


class RoughDataWarning(SourceWarning):
    """The matrices of the source jump from a frequency on: its trusted band ends below it."""


class PartialSetWarning(SourceWarning):
    """Files of a set cover different periods, headings or speeds: only the common ones are read."""


class SeveralSpeedsWarning(SourceWarning):
    """The source holds several forward speeds and none was chosen: motions of the others are not seen."""


class EncounterFrequencyWarning(SourceWarning):
    """Matrices at forward speed are not known as one function of encounter frequency: motions are off."""


class HydrostaticsWarning(SourceWarning):
    """The hydrostatics of a set contradict its matrices: mass, restoring or both are of another loading."""


class FloatingPositionWarning(SourceWarning):
    """The hull would not float as drawn with this mass and centre of gravity."""


class SubmergedPartWarning(SourceWarning):
    """A part of the hull that hangs under water apart from the rest is missing from the strip theory."""
