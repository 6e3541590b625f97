using System;
using LagSim.Contacts;
using LagSim.Islands;
using LagSim.Motion;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Response;

/// <summary>What the hands of an impact may give in it, and what they have given: see <see cref="HandStrength"/>.</summary>
/// <remarks>
/// An impact takes no time, so a force alone does not bound it. A hand gives in impacts what its force gives in the time that has passed, and a
/// blow more. How much of that it has given already is on its path (<see cref="Hold.BusyUntil"/>), in the segment that each impact opens.
/// </remarks>
internal sealed class HandBlows(BodyTable bodies, TimelineStore timelines, ContactGraph graph, CaptureRule capture, SolverRules rules)
{
    /// <summary>The largest impulse that a held body may give in all contacts of an impact together, friction included, in N s.</summary>
    internal double Room(int body, SimTime now)
    {
        Hold hold = timelines.HoldOf(timelines.Last(graph.Slots[body]));
        return rules.BoundsHands
            ? HandStrength.ForceAt(hold, bodies.Spec(graph.Slots[body]).Mass, graph.Velocities[body].Length) * HandStrength.BlowLeft(hold, now)
            : double.PositiveInfinity;
    }

    /// <summary>
    /// Whether what a hand strikes may stay in contact with it: it is backed by something else, or would take more than the hand may give so
    /// that it rebounds.
    /// </summary>
    internal bool MayPress(SimTime now)
    {
        bool may = false;
        for (int b = 0; b < graph.BodyCount && !may; b++)
        {
            may = double.IsPositiveInfinity(graph.Masses[b]) && WantedOf(b) > Room(b, now);
        }

        for (int i = 0; i < graph.ContactCount && !may; i++)
        {
            may = graph.IsByHand(graph.Contacts[i]) && capture.IsBacked(graph.Contacts[i]);
        }

        return may;
    }

    /// <summary>The impulse that a held body has given in the impact that was solved, with the most friction that goes with it, in N s.</summary>
    internal double GivenBy(int body)
    {
        double given = 0;
        foreach (ref readonly ContactPoint c in graph.Contacts)
        {
            given += c.First == body || c.Second == body ? c.Impulse * HandStrength.WithFriction(graph.FrictionOf(c)) : 0;
        }

        return given;
    }

    private double WantedOf(int body)
    {
        double wanted = 0;
        foreach (ref readonly ContactPoint c in graph.Contacts)
        {
            if (c.First == body || c.Second == body)
            {
                double change = Math.Max(0, c.Target - ImpactSolver.Opening(c, graph.Velocities));
                wanted += change * graph.Masses[c.First == body ? c.Second : c.First] * HandStrength.WithFriction(graph.FrictionOf(c));
            }
        }

        return wanted;
    }
}
