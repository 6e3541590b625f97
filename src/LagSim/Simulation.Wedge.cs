using System;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim;

/// <content>Wedges: bodies without play, that every push drives into something that cannot give way.</content>
/// <remarks>
/// A hop parts what lasting contact brings together, where there is room for it. In a wedge there is none: each impact closes another contact, until the
/// tick's collapse has taken the rest, and a microsecond later gravity begins anew. What has gone through that time after time is wedged: a hand goes through
/// it, even one that keeps still, and what does not move any more rests.
/// </remarks>
public sealed partial class Simulation
{
    /// <summary>From this many impacts on the spot on, those after <see cref="SqueezedAfter"/> all without play, a body is wedged.</summary>
    internal const int WedgedAfter = 128;

    /// <summary>So soon after an impact no hop ends: 15 microseconds, where one takes 900 under the earth's gravity.</summary>
    private static readonly SimDuration NoPlay = SimDuration.FromTicks(1L << 24);

    /// <summary>How long what is wedged rests, or lets a hand through, at a time: 50 ms, in which what a hand carried falls a centimetre.</summary>
    internal static readonly SimDuration WedgedFor = SimDuration.FromMilliseconds(50);

    /// <summary>Looks at every impact of what is wedged: only a test's negative control sets it.</summary>
    internal bool IgnoresWedges { get; set; }

    /// <summary>Whether there is no room for a hop between an impact and the next: nothing ended it within its tick, or its rest comes this soon.</summary>
    private static bool IsWithoutPlay(in EventKey impact, SimTime next) =>
        impact.Round >= CollapseRound || (next > impact.Time && next - impact.Time <= NoPlay);

    /// <summary>From when on a hand may push a body on this piece of its path, looked at from <paramref name="time"/>: not while that is wedged and has not come to rest.</summary>
    private SimTime PushedFrom(int segment, SimTime time)
    {
        ref readonly MotionSegment path = ref timelines.Segment(segment);
        SimTime until = timelines.Key(segment).Time + WedgedFor;
        return path.Law != MotionLaw.Resting && path.Crowding >= WedgedAfter && time <= until ? until + SimDuration.OneTick : time;
    }

    /// <summary>Whether the impact at hand is of wedged bodies alone, and leaves them at rest as far as collapses can tell.</summary>
    private bool AreLeftWedged(SimTime time)
    {
        bool areWedged = !Scene.Box.Exists; // there all is in flight
        for (int i = 0; i < partyCount && areWedged; i++)
        {
            areWedged = CrowdingAt(parties[i], time) >= WedgedAfter && partyVelocities[i].Length <= CollapseSpeed && !IsHeld(timelines.Last(parties[i]));
        }

        return areWedged;
    }

    /// <summary>Whether a hand takes part in the impact at hand, and the body rested wedged until now: it may be pushed out, so it is not wedged any more before it has been found so again.</summary>
    private bool IsPushedOutOfRest(int slot)
    {
        bool hasHand = Array.IndexOf(partyMasses, double.PositiveInfinity, 0, partyCount) >= 0;
        return hasHand && RestsWedged(timelines.Segment(timelines.Last(slot)));
    }

    private static bool RestsWedged(in MotionSegment path) => path.Law == MotionLaw.Resting && path.Crowding == WedgedAfter;

    private void RestWedged(int party, in EventKey key)
    {
        Vector3D position = partyPositions[party].WithoutNegativeZero();
        Append(parties[party], key, MotionSegment.AtRest(key.Time, position, key.Time + WedgedFor).WithCrowding(WedgedAfter), default);
    }

    /// <summary>What rested wedged is free again: if nothing has changed, the next impact leaves it at rest.</summary>
    private void EndWedgedRest(int slot, in EventKey key)
    {
        MotionSegment rest = timelines.Segment(timelines.Last(slot));
        OpenFlight(slot, key, rest.Position, Vector3D.Zero, rest.Crowding);
    }
}
