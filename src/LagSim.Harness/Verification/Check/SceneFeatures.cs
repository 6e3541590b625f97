using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Harness.Verification.Check;

/// <summary>
/// The rare features of a session, found in the reference at every event and right before those of players.
/// </summary>
public readonly record struct SceneFeatures
{
    private const int Large = 5;
    private const int Often = 10;
    private const double Touching = 1e-6; // metres
    private static readonly SimDuration AtOnce = SimDuration.FromMilliseconds(100);

    /// <summary>The features, by the names that scripts use, in order.</summary>
    public static IReadOnlyList<(string Name, Func<SceneFeatures, bool> IsMet)> All { get; } =
    [
        ("large_island", met => met.LargeIsland), ("hand_in_island", met => met.HandInIsland), ("removal_from_island", met => met.RemovalFromIsland),
        ("magnus", met => met.Magnus), ("force_in_contact", met => met.ForceInContact), ("steps_ahead", met => met.ContactSteps),
        ("periodic_box", met => met.PeriodicBox), ("closed_orbit", met => met.ClosedOrbit), ("other_pull", met => met.OtherPull), ("wind", met => met.Wind),
        ("fixed_steps", met => met.FixedSteps), ("force_on_sphere", met => met.ForceOnSphere), ("force_with_rolling", met => met.ForceWithRolling),
        ("filter_changed", met => met.FilterChanged),
        ("crossings", met => met.Crossings), ("rules_called", met => met.RulesCalled), ("two_in_contact", met => met.TwoInContact),
        ("players_heard", met => met.PlayersHeard),
    ];

    /// <summary>Five or more touching bodies moved as an island.</summary>
    public bool LargeIsland { get; init; }

    /// <summary>A hand took a body of an island of two or more, moving or at rest.</summary>
    public bool HandInIsland { get; init; }

    /// <summary>A body of such an island was removed.</summary>
    public bool RemovalFromIsland { get; init; }

    /// <summary>The Magnus force bent the path of a body in flight.</summary>
    public bool Magnus { get; init; }

    /// <summary>A body with a force other than gravity was in persistent contact under both.</summary>
    public bool ForceInContact { get; init; }

    /// <summary>Contact steps were taken.</summary>
    public bool ContactSteps { get; init; }

    /// <summary>The world was a periodic box.</summary>
    public bool PeriodicBox { get; init; }

    /// <summary>A body flew by the closed form of an inverse-square attraction.</summary>
    public bool ClosedOrbit { get; init; }

    /// <summary>A body flew under an attraction with a negative power and without a closed form.</summary>
    public bool OtherPull { get; init; }

    /// <summary>A drag acted on a body in a moving medium.</summary>
    public bool Wind { get; init; }

    /// <summary>A body flew by <see cref="MotionLaw.DormandPrince54"/> with fixed steps.</summary>
    public bool FixedSteps { get; init; }

    /// <summary>A body with a force other than gravity was in persistent contact with a static sphere.</summary>
    public bool ForceOnSphere { get; init; }

    /// <summary>A body with a force other than gravity was in persistent contact with rolling resistance.</summary>
    public bool ForceWithRolling { get; init; }

    /// <summary>A player changed what a body collides with.</summary>
    public bool FilterChanged { get; init; }

    /// <summary>Rules were called ten times or more.</summary>
    public bool RulesCalled { get; init; }

    /// <summary>Two players acted within a tenth of a second on one body that was awake, in contact steps.</summary>
    public bool TwoInContact { get; init; }

    /// <summary>Rules heard of a player who left, or came back.</summary>
    public bool PlayersHeard { get; init; }

    /// <summary>Bodies entered and left sensors, ten times or more.</summary>
    public bool Crossings { get; init; }

    /// <param name="alone">The world, advanced to its end, with unlimited history.</param>
    /// <param name="accepted">The accepted events of players.</param>
    /// <param name="contactSteps">The number of contact steps.</param>
    internal static SceneFeatures Of(Simulation alone, IReadOnlyList<ExternalEvent> accepted, long contactSteps)
    {
        SceneFeatures met = new()
        {
            ContactSteps = contactSteps > 0,
            PeriodicBox = alone.Scene.Box.Exists,
            Crossings = alone.Crossings(alone.Start, alone.SimulatedTo).Count >= Often,
            RulesCalled = alone.Engine.Rules?.Position >= Often,
            PlayersHeard = accepted.Any(e => e.PlayerEvent?.Kind is PlayerEventKind.Returned or PlayerEventKind.Left),
        };
        List<(BodyId Body, BodySpec Spec, BodyState State)> there = [];
        Dictionary<EventKey, int> steps = [];
        for (int n = 0; n < alone.BodyCount; n++)
        {
            BodyId body = alone.BodyAt(n);
            BodySpec spec = alone.SpecOf(body);
            ForceSet forces = spec.Forces;
            Force[] acting = [.. Enumerable.Range(0, alone.Scene.Forces.Count).Where(forces.Contains).Select(i => alone.Scene.Forces[i])];
            bool isPulled = acting.Any(f => f.Kind == ForceKind.Central && f.Power < 0);
            bool isBlownAt = acting.Any(f => f.Kind is ForceKind.LinearDrag or ForceKind.QuadraticDrag && f.Vector != Vector3D.Zero);
            foreach (TimelineEntry entry in alone.Timeline(body))
            {
                BodyState state = entry.State;
                bool isInContact = state.Motion is MotionLaw.Constrained or MotionLaw.Sliding or MotionLaw.Rolling or MotionLaw.Resting;
                if (!forces.IsEmpty && state.Motion is not (MotionLaw.Absent or MotionLaw.Held))
                {
                    met = met with
                    {
                        Magnus = met.Magnus || (!isInContact && forces.Contains(CheckScene.Magnus) && Vector3D.Cross(state.Spin, state.Velocity) != Vector3D.Zero),
                        ForceInContact = met.ForceInContact || (isInContact && alone.Scene.Gravity != Vector3D.Zero),
                        ClosedOrbit = met.ClosedOrbit || (isPulled && state.Motion == MotionLaw.ClosedForm),
                        OtherPull = met.OtherPull || (isPulled && state.Motion is (MotionLaw.DormandPrince54 or MotionLaw.RungeKutta4)),
                        Wind = met.Wind || isBlownAt,
                        FixedSteps = met.FixedSteps || (state.Motion == MotionLaw.DormandPrince54 && spec.Tolerance == 0),
                        ForceOnSphere = met.ForceOnSphere || (isInContact && alone.Scene.StaticSpheres.Any(s => IsOn(s, state, spec))),
                        ForceWithRolling = met.ForceWithRolling || (isInContact && spec.RollingResistance > 0),
                    };
                }

                if (state.Motion == MotionLaw.Constrained && !met.LargeIsland)
                {
                    // All bodies of an island begin their segments with one key; others, beside it, may do so as well.
                    int count = steps[entry.Key] = steps.GetValueOrDefault(entry.Key) + 1;
                    if (count >= Large)
                    {
                        Read(alone, entry.Key.Time, there);
                        met = met with { LargeIsland = CountIsland(there, there.FindIndex(b => b.Body == body), MotionLaw.Constrained) >= Large };
                    }
                }
            }
        }

        foreach (ExternalEvent external in accepted)
        {
            if (external.Kind == EventKind.SetFilter)
            {
                met = met with { FilterChanged = met.FilterChanged || alone.TookEffect(external) };
            }
            else if (external.Kind is EventKind.Grab or EventKind.Remove)
            {
                Read(alone, SimTime.Max(external.Time - SimDuration.OneTick, alone.Start), there);
                int at = there.FindIndex(b => b.Body == external.Body);
                bool isOfIsland = CountIsland(there, at, MotionLaw.Resting) >= 2;
                met = met with
                {
                    HandInIsland = met.HandInIsland || (isOfIsland && external.Kind == EventKind.Grab),
                    RemovalFromIsland = met.RemovalFromIsland || (isOfIsland && external.Kind == EventKind.Remove),
                };
            }
        }

        return met with { TwoInContact = HasTwoInContact(alone, accepted) };
    }

    private static bool HasTwoInContact(Simulation alone, IReadOnlyList<ExternalEvent> accepted)
    {
        Dictionary<BodyId, ExternalEvent> lasts = [];
        foreach (ExternalEvent act in accepted.OrderBy(e => e.Key).Where(e => e.Kind is EventKind.SetVelocity or EventKind.Impulse))
        {
            bool isSoon = lasts.TryGetValue(act.Body, out ExternalEvent last) && last.Peer != act.Peer && last.Time < act.Time && act.Time - last.Time <= AtOnce;
            if (isSoon && alone.TryRead(act.Body, SimTime.Max(act.Time - SimDuration.OneTick, alone.Start), out BodyState state) && state.Motion == MotionLaw.Constrained)
            {
                return true;
            }

            lasts[act.Body] = act;
        }

        return false;
    }

    private static bool IsOn(in StaticSphere sphere, in BodyState state, in BodySpec spec) =>
        (state.Position - sphere.Centre).Length - sphere.Radius - spec.Radius <= Touching;

    private static void Read(Simulation alone, SimTime time, List<(BodyId Body, BodySpec Spec, BodyState State)> there)
    {
        there.Clear();
        for (int n = 0; n < alone.BodyCount; n++)
        {
            BodyId body = alone.BodyAt(n);
            if (alone.TryRead(body, time, out BodyState state) && state.Motion != MotionLaw.Absent)
            {
                there.Add((body, alone.SpecOf(body), state));
            }
        }
    }

    /// <summary>
    /// Returns the number of touching bodies that move in contact steps, or by the other given law, reachable from a body; none if that
    /// body does not, or is not there: something may have removed it at that very tick.
    /// </summary>
    private static int CountIsland(List<(BodyId Body, BodySpec Spec, BodyState State)> there, int from, MotionLaw other)
    {
        if (from < 0 || !IsOf(there[from].State))
        {
            return 0;
        }

        List<int> island = [from];
        for (int i = 0; i < island.Count; i++)
        {
            (_, BodySpec spec, BodyState state) = there[island[i]];
            for (int j = 0; j < there.Count; j++)
            {
                double gap = (there[j].State.Position - state.Position).Length - spec.Radius - there[j].Spec.Radius;
                if (gap <= Touching && IsOf(there[j].State) && !island.Contains(j))
                {
                    island.Add(j);
                }
            }
        }

        return island.Count;

        bool IsOf(in BodyState state) => state.Motion == MotionLaw.Constrained || state.Motion == other;
    }
}
