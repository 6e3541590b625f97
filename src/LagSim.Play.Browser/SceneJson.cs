using System;
using System.Runtime.Versioning;
using System.Text.Json;
using LagSim.Scenes;

namespace LagSim.Play.Browser;

/// <summary>What stands still in a scene, for the page to draw.</summary>
[SupportedOSPlatform("browser")]
internal static class SceneJson
{
    /// <summary>Writes the rectangle of the view, the planes that are seen from the side as <c>lines</c>, and the spheres as
    /// <c>discs</c>.</summary>
    internal static void WriteView(Utf8JsonWriter json, PlayScene view)
    {
        json.WriteNumber("left", view.Left);
        json.WriteNumber("bottom", view.Bottom);
        json.WriteNumber("right", view.Right);
        json.WriteNumber("top", view.Top);
        json.WriteStartArray("lines");
        foreach (StaticPlane plane in view.Scene.Planes)
        {
            (double x, double y) = view.ToView(plane.Normal);
            if ((x * x) + (y * y) > 0.5)
            {
                WriteNumbers(json, x, y, plane.Offset);
            }
        }

        json.WriteEndArray();
        json.WriteStartArray("discs");
        foreach (StaticSphere sphere in view.Scene.StaticSpheres)
        {
            (double x, double y) = view.ToView(sphere.Centre);
            WriteNumbers(json, x, y, sphere.Radius);
        }

        json.WriteEndArray();
    }

    private static void WriteNumbers(Utf8JsonWriter json, params ReadOnlySpan<double> values)
    {
        json.WriteStartArray();
        foreach (double value in values)
        {
            json.WriteNumberValue(value);
        }

        json.WriteEndArray();
    }
}
