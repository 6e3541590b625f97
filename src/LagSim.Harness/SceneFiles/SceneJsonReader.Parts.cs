using System.Collections.Generic;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.SceneFiles;

/// <content>Planes, static spheres and bodies.</content>
internal ref partial struct SceneJsonReader
{
    private void ReadPlane()
    {
        string name = "";
        Vector3D normal = default;
        Vector3D? point = null;
        double? offset = null;
        double restitution = 1;
        double friction = Limits.MaxFriction;
        uint seen = 0;
        cursor.EnterObject();
        while (cursor.NextKey(PlaneKeys, ref seen) is string key)
        {
            switch (key)
            {
                case "name":
                    name = Name();
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

        Add(b => _ = point is Vector3D through ? b.AddPlane(name, normal, through, restitution, friction) : b.AddPlane(name, normal, offset!.Value, restitution, friction));
    }

    private void ReadSphere()
    {
        string name = "";
        Vector3D centre = default;
        double radius = 0;
        double restitution = 1;
        double friction = Limits.MaxFriction;
        uint seen = 0;
        cursor.EnterObject();
        while (cursor.NextKey(SphereKeys, ref seen) is string key)
        {
            switch (key)
            {
                case "name":
                    name = Name();
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
                default:
                    restitution = cursor.Number();
                    break;
            }
        }

        Add(b => b.AddStaticSphere(name, centre, radius, restitution, friction));
    }

    private void ReadBody()
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
        List<string> forces = new();
        double tolerance = BodySpec.DefaultTolerance;
        double friction = 0;
        double rollingResistance = 0;
        Vector3D spin = default;
        uint seen = 0;
        cursor.EnterObject();
        while (cursor.NextKey(BodyKeys, ref seen) is string key)
        {
            switch (key)
            {
                case "name":
                    name = Name();
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
                    motion = Motion();
                    break;
                case "players":
                    players = Peers();
                    break;
                case "forces":
                    forces = ForcesOnBody();
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
                default:
                    step = Step();
                    break;
            }
        }

        List<string> known = forceNames;
        bool isAlone = locate is not null; // and no force exists
        Add(b =>
        {
            ForceSet set = isAlone ? ForceSet.None : SetOf(forces, known);
            b.AddBody(name, new BodySpec(radius, mass, restitution, motion, step, set, tolerance, friction, rollingResistance), position, velocity, players, spin);
        });
    }
}
