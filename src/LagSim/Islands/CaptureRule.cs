using System;
using LagSim.Collisions;
using LagSim.Contacts;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;
using LagSim.Trajectories;

namespace LagSim.Islands;

/// <summary>Decides which rebound is the last of its contact, which then persists (docs/CONTACT.md, rule 7).</summary>
internal sealed class CaptureRule(
    Scene scene, TimelineStore timelines, ContactGraph graph, ContactScale scale, MemberFactory members, SlipFactory friction,
    bool hasIslands)
{
    private readonly StaticSurfaces surfaces = scene.Surfaces;
    private readonly Paths paths = new(timelines);

    /// <summary>
    /// Whether a rebound is the last of its contact, which persists from then on (docs/CONTACT.md, rule 7). Never for an elastic contact.
    /// For two that are members already, if it is slower than the capture speed. For any other, if something presses them together so that
    /// the rebound would rise less than the contact tolerance, and all bounces to come would be over within a step.
    /// </summary>
    internal bool IsLast(in ContactPoint c, double restitution, double rebound, SimTime time)
    {
        if (!hasIslands)
        {
            return false;
        }

        bool isPair = c.Second != ContactPoint.Static;
        int members = 0;
        int hands = 0;
        for (int n = 0; n < (isPair ? 2 : 1); n++)
        {
            int piece = timelines.Last(graph.Slots[n == 0 ? c.First : c.Second]);
            members += paths.IsMember(piece) ? 1 : 0;
            hands += paths.IsHeld(piece) ? 1 : 0;
        }

        if (isPair && hands == 1 && (members > 0 || IsBacked(c)))
        {
            return rebound <= scale.CaptureSpeed; // whatever its restitution: a hand gives and takes energy
        }

        if (isPair && hands == 0 && graph.GapOf(c) < -scale.SunkDepth)
        {
            return true; // one was put into the other
        }

        if (IsCarriedByClosedForm(c))
        {
            return false;
        }

        if (restitution < 1 && isPair && members > 0) // leaves at the next tick if nothing presses it: a chord has no acceleration to test
        {
            return rebound <= scale.CaptureSpeedAt(Math.Max(PullOn(c.First, time), PullOn(c.Second, time)));
        }

        Vector3D velocity = graph.Velocities[c.First] - (isPair ? graph.Velocities[c.Second] : Vector3D.Zero);
        Vector3D acceleration = graph.Accelerations[c.First] - (isPair ? graph.Accelerations[c.Second] : Vector3D.Zero);
        double pressing = -Vector3D.Dot(c.Normal, acceleration) - CollisionPredictor.FallingAway(c.Normal, velocity, graph.ReachOf(c));
        double rises = restitution < 1 && !IsAlone(c) ? scale.Length : scene.RestitutionThreshold;
        return pressing > 0 && rebound * rebound <= 2 * pressing * rises && (restitution >= 1 || 2 * rebound <= pressing * (1 - restitution) * scale.Step.ToSeconds());
    }

    private double PullOn(int body, SimTime time) => members.PullOn(graph.Slots[body], time, graph.Positions[body], graph.Velocities[body], graph.Spins[body]);

    /// <summary>
    /// Whether a contact is of a body that touches nothing else, and has not lasted: one that bounces alone. Its bounces are followed
    /// down to
    /// the restitution threshold, whatever acts on it.
    /// </summary>
    private bool IsAlone(in ContactPoint c)
    {
        int piece = timelines.Last(graph.Slots[c.First]);
        return c.Second == ContactPoint.Static && graph.ContactCount == 1
            && !paths.IsMember(piece) && timelines.Segment(piece).Supports.Count == 0;
    }

    /// <summary>
    /// Whether the bounces of a contact are followed down to the scene's restitution threshold, and a closed form carries its body then:
    /// alone on planes, of which one rubs at most if it is the only one.
    /// </summary>
    private bool IsCarriedByClosedForm(in ContactPoint c)
    {
        if (!graph.IsSupportable(c) || paths.IsMember(timelines.Last(graph.Slots[c.First])))
        {
            return false;
        }

        int planes = 0;
        bool rubs = false;
        SupportSet supports = timelines.Segment(timelines.Last(graph.Slots[c.First])).Supports;
        for (int k = 0; k < supports.Count; k++)
        {
            planes++;
            rubs |= friction.On(graph.Slots[c.First], supports[k]) > 0;
        }

        for (int i = 0; i < graph.ContactCount; i++)
        {
            ref readonly ContactPoint other = ref graph.Contacts[i];
            if (other.First == c.First && other.Second == ContactPoint.Static && surfaces.IsPlane(other.Surface))
            {
                planes++;
                rubs |= graph.FrictionOf(other) > 0;
            }
        }

        return planes == 1 || !rubs;
    }

    /// <summary>Whether a body that a hand strikes touches something else as well, against which it may be pressed.</summary>
    internal bool IsBacked(in ContactPoint c)
    {
        int struck = paths.IsHeld(timelines.Last(graph.Slots[c.First])) ? c.Second : c.First;
        return graph.ContactCount > 1 || timelines.Segment(timelines.Last(graph.Slots[struck])).Supports.Count > 0;
    }
}
