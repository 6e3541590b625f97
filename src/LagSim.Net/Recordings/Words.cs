using System.Globalization;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Recordings;

/// <summary>Helpers for building sentences.</summary>
internal static class Words
{
    /// <summary><c>1 log entry</c>, <c>2 log entries</c>.</summary>
    internal static string Count(int count, string one)
    {
        string many = one.EndsWith('y') ? one.Substring(0, one.Length - 1) + "ies" : one + "s";
        return string.Format(CultureInfo.InvariantCulture, "{0} {1}", count, count == 1 ? one : many);
    }

    /// <summary>A body's name in the scene, or its identity if it was spawned.</summary>
    internal static string Named(Scene scene, BodyId body) =>
        body.Index < scene.Bodies.Count && body.Equals(BodyId.OfScene(body.Index)) ? $"'{scene.Bodies[body.Index].Name}'" : $"the spawned body {body}";

    /// <summary>A time as peers print it, in seconds since the session's start: <c>T 6 s</c>.</summary>
    internal static string SinceStart(SimTime time, SimTime start) =>
        string.Format(CultureInfo.InvariantCulture, "T {0} s", (time - start).ToSeconds());
}
