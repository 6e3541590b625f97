using System;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Contacts;

/// <summary>
/// The lengths, speeds and spans that decide persistent contact. They follow from a scene's contact tolerance d and from the acceleration
/// that presses its bodies together.
/// </summary>
/// <remarks>
/// <para>A body that falls freely for a step of h leaves the chord of its path by a h^2 / 8 at most, and gains a h of speed. With h at most
/// sqrt(2 d / a) the first is at most d / 4, and the second at most the speed from which a body rises by d. So all of these are one length,
/// seen as a time, a speed and a place.</para>
/// <para>Immutable; the same on every peer.</para>
/// </remarks>
internal class ContactScale
{
    /// <summary>No step is longer: one frame of an old screen, so that a moving heap is seen to move.</summary>
    private const long LongestTicks = SimDuration.TicksPerSecond / 64;

    /// <summary>The shortest step that the tolerance asks for, 2^-20 s: a gap that closes sooner counts as closing at once.</summary>
    private const long ShortestByTolerance = ContactTime.SoonTicks;

    /// <summary>The shortest step, which only forces on what is fast ask for: that of a flight under error control.</summary>
    internal static readonly long ShortestTicks = StepSize.Shortest.Ticks;

    /// <summary>
    /// The assumed pressing acceleration where the scene has no gravity, in m/s². Hands and forces are not known beforehand, and a hand
    /// moves things by about this much.
    /// </summary>
    private const double MinPull = 1;

    /// <summary>
    /// The sweeps leave contacts to close by this part of the tolerance in a step. Measured: at a twentieth friction at the edge of rolling
    /// is turned aside (<c>hard groove</c>).
    /// </summary>
    private const double SweepPart = 0.005;

    /// <summary>The time in which no member of an island may have moved by the tolerance before the island sleeps.</summary>
    internal static readonly SimDuration StillFor = SimDuration.FromTicks(SimDuration.TicksPerSecond / 2);

    private readonly SimTime start;
    private readonly double weight; // the size of gravity, in m/s²

    /// <summary>The scale of a scene.</summary>
    /// <param name="tolerance">The contact tolerance, in metres.</param>
    /// <param name="gravity">The scene's gravity.</param>
    /// <param name="start">When the scene began, from which on the common clock counts.</param>
    internal ContactScale(double tolerance, in Vector3D gravity, SimTime start)
    {
        this.start = start;
        Length = tolerance;
        weight = gravity.Length;
        Pull = Math.Max(gravity.Length, MinPull);
        double seconds = Math.Sqrt(2 * tolerance / Pull);
        long ticks = LongestTicks;
        while (ticks > ShortestByTolerance && ticks > seconds * SimDuration.TicksPerSecond)
        {
            ticks >>= 1;
        }

        Step = SimDuration.FromTicks(ticks);
        CaptureSpeed = Math.Sqrt(2 * tolerance * Pull);
        SweepSpeed = SweepPart * tolerance / Step.ToSeconds();
        SpeculativeMargin = Math.Min(tolerance, 2 * Pull * Step.ToSeconds() * Step.ToSeconds());
        StillSpeed = tolerance / StillFor.ToSeconds();
    }

    /// <summary>The shortest step, in seconds, for a force that may last: with a shorter one there would be more than a million in a second.</summary>
    internal static readonly double ShortestLasting = SimDuration.FromTicks(ShortestByTolerance).ToSeconds();

    /// <summary>
    /// Whether steps follow a force that acts at a rate, in 1/s, for as long as it may last: 2^20 1/s at most. What is not a number is not
    /// followed.
    /// </summary>
    internal static bool IsFollowed(double rate) => rate * ShortestLasting <= 1;

    /// <summary>
    /// The same for as long as the body's own speed makes the force that fast. A drag takes half of such a speed in one part of its rate, so
    /// however fast the body is, a few hundred steps later its rate is one that lasts.
    /// </summary>
    internal static bool IsFollowedFor(double rate) => rate * StepSize.Shortest.ToSeconds() <= 1;

    /// <summary>The contact tolerance d, in metres.</summary>
    internal double Length { get; }

    /// <summary>
    /// How deep, in metres, two are in each other of whom one was put there: half of what is predicted from, so that rounding cannot part
    /// the
    /// two rules.
    /// </summary>
    internal double SunkDepth => 0.5 * Length;

    /// <summary>
    /// The speculative margin, in metres: pairs that come within it in a step are contacts of the step. Two bodies that the pull drives at
    /// each other from rest close by this much in a step. Never more than the tolerance, and less only where that would allow a step longer
    /// than the longest.
    /// </summary>
    internal double SpeculativeMargin { get; }

    /// <summary>The acceleration that presses bodies together, in m/s²: the scene's gravity.</summary>
    internal double Pull { get; }

    /// <summary>
    /// The length of a contact step where no force asks for less: the largest power of two of ticks in which a fall stays within the
    /// tolerance.
    /// </summary>
    internal SimDuration Step { get; }

    /// <summary>The speed, in m/s, from which a body rises by the tolerance against what a hand presses with.</summary>
    internal double CaptureSpeed { get; }

    /// <summary>
    /// The speed, in m/s, from which a body rises by the tolerance where forces pull it so hard, in m/s², if gravity does not pull harder.
    /// Where neither pulls only a hand can press, as hard as is assumed of one.
    /// </summary>
    internal double CaptureSpeedAt(double pull)
    {
        double press = Math.Max(pull, weight);
        return press > 0 ? Math.Sqrt(2 * Length * press) : CaptureSpeed;
    }

    /// <summary>
    /// The time, in seconds, of a fall by the tolerance where forces pull a body harder than gravity does; infinite otherwise.
    /// </summary>
    internal double FallAt(double pull) => pull > Pull ? Math.Sqrt(2 * Length / pull) : double.PositiveInfinity;

    /// <summary>The closing speed that the sweeps of a step may leave at contacts, in m/s.</summary>
    internal double SweepSpeed { get; }

    /// <summary>How far from touching, in metres, the sweeps of a step may leave a contact that holds.</summary>
    internal double SweepGap => SweepSpeed * Step.ToSeconds();

    /// <summary>The closing speed that impacts within a step may leave at contacts that hold, in m/s.</summary>
    internal double ImpactSpeed => ImpactPart * Length / Step.ToSeconds();

    /// <summary>
    /// Twice the depth, in metres, that a contact that holds may reach before it is tested within a step: because of a hand that speeds up.
    /// </summary>
    internal double LookDepth => 2 * ImpactPart * Length;

    /// <summary>An impact passes from a body to the bodies that it holds if it changed its velocity by more than this, in m/s.</summary>
    internal virtual double ReachSpeed => SweepSpeed;

    /// <summary>A body slower than this, in m/s, does not move by the tolerance while it waits to sleep.</summary>
    internal double StillSpeed { get; }

    /// <summary>
    /// What pulls a body from rest by less than this, in m/s², once contacts have balanced the forces, counts as nothing: it would not move
    /// it by the tolerance within 16 s.
    /// </summary>
    internal double LeastPull => 2 * Length / (16 * 16);

    /// <summary>The speed, in m/s, that sweeps may leave at a contact of an island that hardly moves, however slow it is.</summary>
    internal double FinestSweepSpeed => 0.05 * StillSpeed;

    /// <summary>
    /// How fast, in m/s, two are pushed apart in a step that are deeper in each other than the tolerance. It is the speed of a fall under
    /// the pull by what is deeper, so it ends in the time of that fall and slows down by the pull until then; and besides what shallow
    /// overlap is pushed out at. Never by more than there is.
    /// </summary>
    internal virtual double DeepSpeed(double depth, double seconds) =>
        Math.Min(depth / seconds, (Pull * seconds) + PartSpeed(depth, seconds));

    /// <summary>
    /// The same without what shallow overlap is pushed out at: two that part as fast as this need no push. Zero for shallow overlap.
    /// </summary>
    internal double PartSpeed(double depth, double seconds)
    {
        double excess = depth - Length;
        return excess > 0 ? Math.Min(excess / seconds, Math.Sqrt(2 * Pull * excess)) : 0;
    }

    /// <summary>
    /// Contacts that hold, and that an impact within a step leaves to close by less than this part of the tolerance, are not struck before
    /// the next tick. Measured, on 63 balls that fall into a pit: with none of it 490,000 impacts instead of 600; with a tenth of it 9 %
    /// more impacts, and half the overlap.
    /// </summary>
    private protected virtual double ImpactPart => 10 * SweepPart;

    /// <summary>The first tick at or after an instant of a clock whose steps are not longer than wanted, in seconds.</summary>
    internal SimTime TickFrom(SimTime time, double seconds)
    {
        long step = Step.Ticks;
        while (step > ShortestTicks && step > seconds * SimDuration.TicksPerSecond)
        {
            step >>= 1;
        }

        return start + SimDuration.FromTicks(((time - start).Ticks + step - 1) & -step); // a power of two
    }

    /// <summary>
    /// How long a step may be that begins at a tick: of those that the clock has there the longest that is not longer than wanted.
    /// </summary>
    internal SimDuration StepFrom(SimTime tick, double seconds)
    {
        long step = Step.Ticks;
        while (step > ShortestTicks && (step > seconds * SimDuration.TicksPerSecond || ((tick - start).Ticks & (step - 1)) != 0))
        {
            step >>= 1;
        }

        return SimDuration.FromTicks(step);
    }
}
