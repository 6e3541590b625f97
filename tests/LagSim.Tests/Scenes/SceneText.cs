using System.Text;
using LagSim.Harness.SceneFiles;
using LagSim.Scenes;
using Xunit;

namespace LagSim.Tests.Scenes;

/// <summary>Small scene documents, and what reading them says.</summary>
internal static class SceneText
{
    internal const string Floor = """{"name": "floor", "normal": [0, 1, 0], "offset_m": 0}""";

    internal const string Ball = """{"name": "ball", "radius_m": 0.5, "mass_kg": 1, "restitution": 0.8, "position_m": [0, 10, 0]}""";

    internal const string Valid = """{"format": "lagsim-scene-1", "name": "s", "planes": [""" + Floor + """], "bodies": [""" + Ball + "]}";

    /// <summary>A scene with these further keys at its top.</summary>
    internal static string With(string keys) => """{"format": "lagsim-scene-1", "name": "s", """ + keys + "}";

    /// <summary>A scene with a ball in which a text is replaced.</summary>
    internal static string BallWith(string old, string by)
    {
        Assert.Contains(old, Ball);
        return With("\"bodies\": [" + Ball.Replace(old, by) + "]");
    }

    internal static Scene Parse(string json) => SceneFile.Parse(Encoding.UTF8.GetBytes(json), "s.json");

    internal static SceneFileException Refusal(string json) => Refusal(Encoding.UTF8.GetBytes(json));

    internal static SceneFileException Refusal(byte[] json) => Assert.Throws<SceneFileException>(() => SceneFile.Parse(json, "s.json"));

    /// <summary>Reading the document fails at that path, with a message that names the file and says this.</summary>
    internal static SceneFileException Refuses(string json, string path, string says)
    {
        SceneFileException refusal = Refusal(json);
        Assert.Equal(path, refusal.Path);
        Assert.StartsWith("s.json: ", refusal.Message);
        Assert.Contains(says, refusal.Message);
        Assert.DoesNotContain('\n', refusal.Message);
        Assert.InRange(refusal.Message.Length, 20, 600);
        return refusal;
    }
}
