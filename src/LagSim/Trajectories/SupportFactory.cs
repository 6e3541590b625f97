using System;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Trajectories;

/// <summary>Opens rest on planes and motion along them, by closed forms.</summary>
internal sealed class SupportFactory(Scene scene, BodyTable bodies, TimelineStore timelines, StateLimits limits, BodyLoss loss, SlipFactory friction)
{
    private readonly StaticSurfaces surfaces = scene.Surfaces;

    /// <summary>
    /// Rest or sliding, if after the impact no bounce is left that the scene resolves. The bounces that remain rise at most w^2 / 2a and
    /// last 2w / (a (1 - e)) in all, for a rebound at speed w pressed back by a: below the scene's restitution threshold they are left out,
    /// the body is put on the plane, and it rests from the end of that time on. Tangential motion continues unchanged: frictionless bounces
    /// do not affect it.
    /// </summary>
    internal bool TryOpen(
        int slot, in EventKey key, in Vector3D position, in Vector3D velocity, double carry, Span<int> touchedPlanes, in Vector3D spin)
    {
        if (!bodies.Spec(slot).Forces.IsEmpty)
        {
            return false;
        }

        Span<int> slow = touchedPlanes.Length <= 8 ? stackalloc int[8] : new int[touchedPlanes.Length];
        int count = 0;
        foreach (int plane in touchedPlanes)
        {
            double rebound = Vector3D.Dot(surfaces.Plane(plane).Normal, velocity);
            if (Math.Abs(rebound) <= UnresolvedSpeed(plane))
            {
                slow[count++] = plane;
            }
        }

        if (count == 0)
        {
            return false; // as after nearly every bounce
        }

        SupportSet supports = PlaneSupport.Solve(slow.Slice(0, count), scene.PlaneArray, scene.Gravity, out Vector3D acceleration);
        if (supports.Count == 0)
        {
            return false;
        }

        SimDuration left = BouncesLeft(slot, supports, velocity);
        Vector3D tangential = PlaneSupport.Tangential(velocity, supports, scene.PlaneArray);
        Vector3D start = OntoSupports(slot, supports, position + (tangential * carry));
        tangential = (tangential + (acceleration * carry)).WithoutNegativeZero();
        if (!loss.TryAllow(slot, key, start, tangential))
        {
            return true;
        }

        if (supports.Count == 1 && friction.On(slot, supports[0]) > 0)
        {
            friction.Open(slot, key, start, tangential, spin, supports, acceleration, left);
            return true;
        }

        bool rests = tangential == Vector3D.Zero && acceleration == Vector3D.Zero;
        if (rests && left == SimDuration.Zero)
        {
            timelines.Append(slot, bodies.Id(slot), key, MotionSegment.AtRest(key.Time, start, supports), default, spin: new Spin(spin));
        }
        else
        {
            SimTime end = rests ? key.Time + left : limits.EndOfRange(key.Time, tangential, acceleration);
            MotionSegment slide = new(MotionLaw.Sliding, key.Time, end, start, tangential, acceleration, supports);
            timelines.Append(slot, bodies.Id(slot), key, slide, default, spin: new Spin(spin));
        }

        return true;
    }

    /// <summary>The rebound speed below which a bounce on the plane rises less than the scene resolves.</summary>
    private double UnresolvedSpeed(int plane)
    {
        double pressing = -Vector3D.Dot(surfaces.Plane(plane).Normal, scene.Gravity);
        return Math.Sqrt(2 * scene.RestitutionThreshold * (pressing > 0 ? pressing : scene.Gravity.Length));
    }

    /// <summary>How long the bounces that are left out would have lasted; zero for what never loses speed, or has none.</summary>
    private SimDuration BouncesLeft(int slot, SupportSet supports, in Vector3D velocity)
    {
        double longest = 0;
        for (int k = 0; k < supports.Count; k++)
        {
            ref readonly StaticPlane plane = ref surfaces.Plane(supports[k]);
            double rebound = Vector3D.Dot(plane.Normal, velocity);
            double pressing = -Vector3D.Dot(plane.Normal, scene.Gravity);
            double restitution = Math.Min(plane.Restitution, bodies.Spec(slot).Restitution);
            if (rebound > 0 && pressing > 0 && restitution < 1)
            {
                longest = Math.Max(longest, 2 * rebound / (pressing * (1 - restitution)));
            }
        }

        return TickConversion.TryFromSeconds(longest, out long ticks) ? SimDuration.FromTicks(ticks) : SimDuration.Zero;
    }

    /// <summary>
    /// The limit of the bounces lies on the plane; only what a bounce below the restitution threshold leaves is taken away, never a real
    /// overlap.
    /// </summary>
    private Vector3D OntoSupports(int slot, SupportSet supports, in Vector3D position)
    {
        Vector3D onto = position;
        for (int k = 0; k < supports.Count; k++)
        {
            ref readonly StaticPlane plane = ref surfaces.Plane(supports[k]);
            double gap = plane.Gap(onto, bodies.Spec(slot).Radius);
            if (Math.Abs(gap) <= scene.RestitutionThreshold)
            {
                onto -= plane.Normal * gap;
            }
        }

        return onto.WithoutNegativeZero();
    }
}
