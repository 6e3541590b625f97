using System;
using System.Buffers;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using System.Text.Encodings.Web;
using System.Text.Json;
using LagSim.Harness.Reports;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.SceneFiles;

/// <summary>A writer of scenes as JSON that is ready to edit and reads back as the same world, to the bit.</summary>
internal static class SceneJsonWriter
{
    private static readonly JsonWriterOptions Options = new()
    {
        Indented = true,
        NewLine = "\n",
        Encoder = JavaScriptEncoder.UnsafeRelaxedJsonEscaping, // a file, not a page: names stay readable
    };

    internal static void Write(Scene scene, IBufferWriter<byte> to)
    {
        using Utf8JsonWriter json = new(to, Options);
        json.WriteStartObject();
        json.WriteString("format", SceneFile.Format);
        json.WriteString("name", scene.Name);
        Vector(json, "gravity_m_per_s2", scene.Gravity);
        json.WriteNumber("resolution_m", scene.RestitutionThreshold);
        json.WriteNumber("contact_tolerance_m", scene.ContactTolerance);

        // Left out where it equals the default for the bodies, so that changing a radius also changes the default.
        if (scene.SmallestRadius != MinRadius(scene))
        {
            json.WriteNumber("smallest_radius_m", scene.SmallestRadius);
        }

        if (scene.Rules is SceneRules rules)
        {
            json.WriteString("rules", rules.Name);
        }

        if (scene.Seed != 0)
        {
            json.WriteNumber("seed", scene.Seed);
        }

        Peers(json, "spawners", scene.Spawners);
        if (scene.Box.Exists)
        {
            Vector(json, "periodic_box_m", scene.Box.Size);
        }

        if (scene.Forces.Count > 0)
        {
            List(json, "forces", scene.Forces, force => WriteForce(json, force));
        }

        List(json, "planes", scene.Planes, plane =>
        {
            json.WriteString("name", plane.Name);
            Vector(json, "normal", plane.Normal);
            json.WriteNumber("offset_m", plane.Offset);
            json.WriteNumber("restitution", plane.Restitution);
            Friction(json, plane.Friction, Limits.MaxFriction);
            Filter(json, plane.Filter);
        });
        List(json, "static_spheres", scene.StaticSpheres, sphere =>
        {
            json.WriteString("name", sphere.Name);
            Vector(json, "centre_m", sphere.Centre);
            json.WriteNumber("radius_m", sphere.Radius);
            json.WriteNumber("restitution", sphere.Restitution);
            Friction(json, sphere.Friction, Limits.MaxFriction);
            Filter(json, sphere.Filter);
        });
        List(json, "bodies", scene.Bodies, body => Body(json, scene, body));
        if (scene.Sensors.Count > 0)
        {
            List(json, "sensors", scene.Sensors, sensor => WriteSensor(json, scene, sensor));
        }

        json.WriteEndObject();
    }

    private static void List<T>(Utf8JsonWriter json, string key, IReadOnlyList<T> parts, Action<T> write)
    {
        json.WriteStartArray(key);
        foreach (T part in parts)
        {
            json.WriteStartObject();
            write(part);
            json.WriteEndObject();
        }

        json.WriteEndArray();
    }

    /// <summary>
    /// Returns the fewest digits that read back as the same number of ticks: 0.005, where the span itself is a sum of powers of two.
    /// </summary>
    internal static double Seconds(SimDuration span)
    {
        double exact = span.ToSeconds();
        for (int digits = 1; digits < 17; digits++)
        {
            double shorter = double.Parse(exact.ToString("E" + (digits - 1), CultureInfo.InvariantCulture), CultureInfo.InvariantCulture);
            if (shorter is >= 1e-6 and <= 1 && SimDuration.FromSeconds(shorter) == span)
            {
                return shorter;
            }
        }

        return exact;
    }

    /// <summary>Returns the smallest radius of a scene that does not set one.</summary>
    private static double MinRadius(Scene scene)
    {
        double least = 1e9;
        foreach (SceneBody body in scene.Bodies)
        {
            least = Math.Min(least, body.Spec.Radius);
        }

        return least;
    }

    private static void Body(Utf8JsonWriter json, Scene scene, in SceneBody body)
    {
        json.WriteString("name", body.Name);
        json.WriteNumber("radius_m", body.Spec.Radius);
        json.WriteNumber("mass_kg", body.Spec.Mass);
        json.WriteNumber("restitution", body.Spec.Restitution);
        Vector(json, "position_m", body.Position);
        Vector(json, "velocity_m_per_s", body.Velocity);
        json.WriteString("motion", MotionNames.Of(body.Spec.Flight));

        // A closed form ignores the step, but the scene's hash includes it.
        if (body.Spec.Flight is MotionLaw.RungeKutta4 or MotionLaw.DormandPrince54 || body.Spec.Step != BodySpec.DefaultStep)
        {
            json.WriteNumber("step_s", Seconds(body.Spec.Step));
        }

        if (!body.Spec.Forces.IsEmpty)
        {
            json.WriteStartArray("forces");
            foreach (Force force in body.Spec.Forces.Among(scene.ForceArray))
            {
                json.WriteStringValue(force.Name);
            }

            json.WriteEndArray();
        }

        if (body.Spec.Tolerance != BodySpec.DefaultTolerance)
        {
            json.WriteNumber("tolerance", body.Spec.Tolerance);
        }

        Friction(json, body.Spec.Friction, 0);
        if (body.Spec.RollingResistance != 0)
        {
            json.WriteNumber("rolling_resistance", body.Spec.RollingResistance);
        }

        if (body.Spin != Vector3D.Zero)
        {
            Vector(json, "spin_rad_per_s", body.Spin);
        }

        Peers(json, "players", body.Players);
        Filter(json, body.Spec.Filter);
        if (body.Spec.Tag != 0)
        {
            json.WriteNumber("tag", body.Spec.Tag);
        }
    }

    private static void Friction(Utf8JsonWriter json, double friction, double byDefault)
    {
        if (friction != byDefault)
        {
            json.WriteNumber("friction", friction);
        }
    }

    private static void Filter(Utf8JsonWriter json, CollisionFilter filter)
    {
        CollisionFilter usual = default;
        if (filter.Category != usual.Category)
        {
            json.WriteNumber("category", filter.Category);
        }

        if (filter.Mask != usual.Mask)
        {
            json.WriteNumber("mask", filter.Mask);
        }
    }

    private static void WriteSensor(Utf8JsonWriter json, Scene scene, in Sensor sensor)
    {
        json.WriteString("name", sensor.Name);
        json.WriteString("shape", SensorNames.Of(sensor.Shape));
        if (sensor.Coverage != SensorCoverage.Centre)
        {
            json.WriteString("coverage", SensorNames.Of(sensor.Coverage));
        }

        bool isPlane = sensor.Shape == SensorShape.Plane;
        Vector(json, isPlane ? "normal" : "centre_m", isPlane ? sensor.Normal : sensor.Centre);
        json.WriteNumber(isPlane ? "offset_m" : "radius_m", isPlane ? sensor.Offset : sensor.Radius);
        Filter(json, sensor.Filter);
        if (sensor.Carrier is BodyId carrier)
        {
            json.WriteString("carrier", scene.Bodies[carrier.Index].Name);
        }
    }

    private static void WriteForce(Utf8JsonWriter json, Force force)
    {
        json.WriteString("name", force.Name);
        json.WriteString("kind", ForceKindNames.Of(force.Kind));
        switch (force.Kind)
        {
            case ForceKind.LinearDrag or ForceKind.QuadraticDrag:
                json.WriteNumber(force.Kind == ForceKind.LinearDrag ? "coefficient_kg_per_s" : "coefficient_kg_per_m", force.Strength);
                Vector(json, "medium_m_per_s", force.Vector);
                break;
            case ForceKind.Spring:
                Vector(json, "anchor_m", force.Vector);
                json.WriteNumber("stiffness_n_per_m", force.Strength);
                json.WriteNumber("damping_kg_per_s", force.Damping);
                break;
            case ForceKind.Magnus:
                json.WriteNumber("coefficient_kg", force.Strength);
                break;
            case ForceKind.Magnetic:
                Vector(json, "field_t", force.Vector);
                json.WriteNumber("charge_c", force.Strength);
                break;
            default:
                Vector(json, "centre_m", force.Vector);
                json.WriteNumber("strength_m_per_s2", force.Strength);
                json.WriteNumber("power", force.Power);
                break;
        }
    }

    /// <summary>Writes the numbers of the peers that have a right, unless all have it.</summary>
    private static void Peers(Utf8JsonWriter json, string key, PeerSet peers)
    {
        if (peers != PeerSet.Everyone)
        {
            json.WritePropertyName(key);
            json.WriteRawValue($"[{string.Join(", ", Enumerable.Range(0, PeerSet.MaxPeer + 1).Where(peers.Contains))}]");
        }
    }

    // On one line; the writer's own indentation would take five.
    private static void Vector(Utf8JsonWriter json, string key, in Vector3D v)
    {
        json.WritePropertyName(key);
        json.WriteRawValue($"[{NumberText.RoundTrip(v.X)}, {NumberText.RoundTrip(v.Y)}, {NumberText.RoundTrip(v.Z)}]");
    }
}
