using System;
using LagSim.Scenes;

namespace LagSim.Harness.SceneFiles;

/// <summary>Reads the sensors of scene files: each becomes what adds it to a scene.</summary>
internal static class SensorJson
{
    private static readonly JsonKeys Keys = new(["name", "shape"], ["coverage", "normal", "point_m", "offset_m", "centre_m", "radius_m", "category", "mask", "carrier"]);

    /// <summary>Reads a sensor.</summary>
    /// <exception cref="SceneFileException">A key is missing, or does not belong to a sensor of that shape.</exception>
    internal static Action<SceneBuilder> Read(ref JsonCursor cursor)
    {
        string name = "";
        string shape = "";
        SensorCoverage coverage = SensorCoverage.Centre;
        Vector3D? normal = null;
        Vector3D? point = null;
        double? offset = null;
        Vector3D? centre = null;
        double? radius = null;
        CollisionFilter filter = default;
        string? carrier = null;
        uint seen = 0;
        cursor.EnterObject();
        while (cursor.NextKey(Keys, ref seen) is string key)
        {
            switch (key)
            {
                case "name":
                    name = SceneJsonValues.Name(ref cursor);
                    break;
                case "shape":
                    shape = Shape(ref cursor);
                    break;
                case "coverage":
                    coverage = Coverage(ref cursor);
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
                case "centre_m":
                    centre = cursor.Vector();
                    break;
                case "category":
                    filter = new CollisionFilter(SceneJsonValues.Bits(ref cursor), filter.Mask);
                    break;
                case "mask":
                    filter = new CollisionFilter(filter.Category, SceneJsonValues.Bits(ref cursor));
                    break;
                case "carrier":
                    carrier = SceneJsonValues.Name(ref cursor);
                    break;
                default:
                    radius = cursor.Number();
                    break;
            }
        }

        bool isPlane = shape == SensorNames.Plane;
        Require(cursor, shape, "normal", normal.HasValue, isPlane);
        Require(cursor, shape, "centre_m", centre.HasValue, !isPlane);
        Require(cursor, shape, "radius_m", radius.HasValue, !isPlane);
        Require(cursor, shape, "point_m", point.HasValue, isPlane && !offset.HasValue);
        Require(cursor, shape, "offset_m", offset.HasValue, isPlane && !point.HasValue);
        if (isPlane && carrier is not null)
        {
            throw cursor.FailAt("carrier", "no body carries a plane; only a sensor of shape \"sphere\" has this key");
        }

        return b => _ = !isPlane ? b.AddSensorSphere(name, centre!.Value, radius!.Value, coverage, filter, carrier)
            : point is Vector3D through ? b.AddSensorPlane(name, normal!.Value, through, coverage, filter)
            : b.AddSensorPlane(name, normal!.Value, offset!.Value, coverage, filter);
    }

    private static string Shape(ref JsonCursor cursor)
    {
        string shape = cursor.String();
        return shape is SensorNames.Plane or SensorNames.Sphere
            ? shape
            : throw cursor.Fail($"the shape {JsonFault.Quote(shape)} is unknown; allowed are \"{SensorNames.Plane}\", \"{SensorNames.Sphere}\"");
    }

    private static SensorCoverage Coverage(ref JsonCursor cursor)
    {
        string name = cursor.String();
        return SensorNames.TryParse(name, out SensorCoverage coverage)
            ? coverage
            : throw cursor.Fail($"the coverage {JsonFault.Quote(name)} is unknown; allowed are {SensorNames.QuotedCoverages}");
    }

    private static void Require(in JsonCursor cursor, string shape, string key, bool isThere, bool isNeeded)
    {
        if (isThere != isNeeded)
        {
            throw cursor.FailAt(
                key, isNeeded
                    ? $"this key is required of a sensor of shape \"{shape}\"; of point_m and offset_m exactly one stands"
                    : $"a sensor of shape \"{shape}\" has normal and one of point_m and offset_m if it is a plane, centre_m and radius_m if it is a sphere");
        }
    }
}
