using System;
using System.Collections.Generic;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.SceneFiles;

/// <summary>Reads the planes, static spheres and bodies of scene files: each becomes what adds it to a scene.</summary>
internal static class PartJson
{
    private static readonly JsonKeys PlaneKeys = new(["name", "normal"], ["point_m", "offset_m", "restitution", "friction", "category", "mask"]);

    private static readonly JsonKeys SphereKeys = new(["name", "centre_m", "radius_m"], ["restitution", "friction", "category", "mask"]);

    private static readonly JsonKeys BodyKeys = new(
        ["name", "radius_m", "mass_kg", "restitution", "position_m"],
        [
            "velocity_m_per_s", "motion", "step_s", "forces", "tolerance", "friction", "rolling_resistance", "spin_rad_per_s", "players",
            "category", "mask", "tag",
        ]);

    /// <summary>Reads a plane.</summary>
    internal static Action<SceneBuilder> Plane(ref JsonCursor cursor)
    {
        string name = "";
        Vector3D normal = default;
        Vector3D? point = null;
        double? offset = null;
        double restitution = 1;
        double friction = Limits.MaxFriction;
        CollisionFilter filter = default;
        uint seen = 0;
        cursor.EnterObject();
        while (cursor.NextKey(PlaneKeys, ref seen) is string key)
        {
            switch (key)
            {
                case "name":
                    name = SceneJsonValues.Name(ref cursor);
                    break;
                case "normal":
                    normal = cursor.Vector();
                    break;
                case "point_m":
                    point = cursor.Vector();
                    break;
                case "offset_m":
                    offset = cursor.Number();
                    break;
                case "friction":
                    friction = cursor.Number();
                    break;
                case "category":
                    filter = new CollisionFilter(SceneJsonValues.Bits(ref cursor), filter.Mask);
                    break;
                case "mask":
                    filter = new CollisionFilter(filter.Category, SceneJsonValues.Bits(ref cursor));
                    break;
                default:
                    restitution = cursor.Number();
                    break;
            }
        }

        if (point.HasValue == offset.HasValue)
        {
            (string key, string count) = point.HasValue ? ("offset_m", "both stand") : ("point_m", "none stands");
            throw cursor.FailAt(key, $"a plane needs point_m or offset_m, exactly one; {count} here");
        }

        return b => _ = point is Vector3D through
            ? b.AddPlane(name, normal, through, restitution, friction, filter)
            : b.AddPlane(name, normal, offset!.Value, restitution, friction, filter);
    }

    /// <summary>Reads a static sphere.</summary>
    internal static Action<SceneBuilder> Sphere(ref JsonCursor cursor)
    {
        string name = "";
        Vector3D centre = default;
        double radius = 0;
        double restitution = 1;
        double friction = Limits.MaxFriction;
        CollisionFilter filter = default;
        uint seen = 0;
        cursor.EnterObject();
        while (cursor.NextKey(SphereKeys, ref seen) is string key)
        {
            switch (key)
            {
                case "name":
                    name = SceneJsonValues.Name(ref cursor);
                    break;
                case "centre_m":
                    centre = cursor.Vector();
                    break;
                case "radius_m":
                    radius = cursor.Number();
                    break;
                case "friction":
                    friction = cursor.Number();
                    break;
                case "category":
                    filter = new CollisionFilter(SceneJsonValues.Bits(ref cursor), filter.Mask);
                    break;
                case "mask":
                    filter = new CollisionFilter(filter.Category, SceneJsonValues.Bits(ref cursor));
                    break;
                default:
                    restitution = cursor.Number();
                    break;
            }
        }

        return b => b.AddStaticSphere(name, centre, radius, restitution, friction, filter);
    }

    /// <summary>Reads a body.</summary>
    /// <param name="cursor">Where it stands.</param>
    /// <param name="forceNames">The forces, of which it may name some.</param>
    /// <param name="isAlone">Whether it is built without them, to find what is wrong with the body itself.</param>
    internal static Action<SceneBuilder> Body(ref JsonCursor cursor, ForceNames forceNames, bool isAlone)
    {
        string name = "";
        double radius = 0;
        double mass = 0;
        double restitution = 0;
        Vector3D position = default;
        Vector3D velocity = default;
        MotionLaw motion = MotionLaw.Automatic;
        SimDuration step = BodySpec.DefaultStep;
        PeerSet players = PeerSet.Everyone;
        IReadOnlyList<string> forces = [];
        double tolerance = BodySpec.DefaultTolerance;
        double friction = 0;
        double rollingResistance = 0;
        Vector3D spin = default;
        CollisionFilter filter = default;
        ulong tag = 0;
        uint seen = 0;
        cursor.EnterObject();
        while (cursor.NextKey(BodyKeys, ref seen) is string key)
        {
            switch (key)
            {
                case "name":
                    name = SceneJsonValues.Name(ref cursor);
                    break;
                case "radius_m":
                    radius = cursor.Number();
                    break;
                case "mass_kg":
                    mass = cursor.Number();
                    break;
                case "restitution":
                    restitution = cursor.Number();
                    break;
                case "position_m":
                    position = cursor.Vector();
                    break;
                case "velocity_m_per_s":
                    velocity = cursor.Vector();
                    break;
                case "motion":
                    motion = SceneJsonValues.Motion(ref cursor);
                    break;
                case "players":
                    players = SceneJsonValues.Peers(ref cursor);
                    break;
                case "forces":
                    forces = forceNames.Read(ref cursor);
                    break;
                case "tolerance":
                    tolerance = cursor.Number();
                    break;
                case "friction":
                    friction = cursor.Number();
                    break;
                case "rolling_resistance":
                    rollingResistance = cursor.Number();
                    break;
                case "spin_rad_per_s":
                    spin = cursor.Vector();
                    break;
                case "category":
                    filter = new CollisionFilter(SceneJsonValues.Bits(ref cursor), filter.Mask);
                    break;
                case "mask":
                    filter = new CollisionFilter(filter.Category, SceneJsonValues.Bits(ref cursor));
                    break;
                case "tag":
                    tag = cursor.Whole(ulong.MaxValue);
                    break;
                default:
                    step = SceneJsonValues.Step(ref cursor);
                    break;
            }
        }

        return b =>
        {
            ForceSet set = isAlone ? ForceSet.None : forceNames.SetOf(forces);
            BodySpec spec = new(radius, mass, restitution, motion, step, set, tolerance, friction, rollingResistance, filter, tag);
            b.AddBody(name, spec, position, velocity, players, spin);
        };
    }
}
