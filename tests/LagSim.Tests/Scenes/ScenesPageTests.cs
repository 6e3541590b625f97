using System;
using System.IO;
using System.Linq;
using LagSim.Harness.SceneFiles;
using LagSim.Scenes;
using Xunit;

namespace LagSim.Tests.Scenes;

/// <summary>docs/SCENES.md says what is true.</summary>
public sealed class ScenesPageTests
{
    private static readonly string Page = Read();

    [Fact]
    public void Example_OfThePage_IsAScene()
    {
        Scene scene = SceneText.Parse(Page.Split("```json\n")[1].Split("```")[0]);

        Assert.Equal(["floor", "ramp"], scene.Planes.Select(p => p.Name));
        Assert.Equal(["ball", "stone"], scene.Bodies.Select(b => b.Name));
        Assert.Equal(MotionLaw.RungeKutta4, scene.Bodies[1].Spec.Flight);
        new Simulation(scene).AdvanceTo(LagSim.Time.SimTime.FromSeconds(3));
    }

    [Theory]
    [InlineData("{\"?\": 0}")]
    [InlineData("{\"planes\": [{\"?\": 0}]}")]
    [InlineData("{\"static_spheres\": [{\"?\": 0}]}")]
    [InlineData("{\"forces\": [{\"?\": 0}]}")]
    [InlineData("{\"sensors\": [{\"?\": 0}]}")]
    [InlineData("{\"bodies\": [{\"?\": 0}]}")]
    public void Tables_OfThePage_HaveEveryKey(string json)
    {
        string[] keys = SceneText.Refusal(json).Message.Split("allowed are ")[1].Split(", ");

        Assert.All(keys, key => Assert.Contains($"| `{key}` |", Page));
    }

    [Fact]
    public void BuiltIns_OfThePage_AreAll() => Assert.All(BuiltInScenes.Names, name => Assert.Contains($"| `{name}` |", Page));

    private static string Read()
    {
        DirectoryInfo? folder = new(AppContext.BaseDirectory);
        while (folder is not null && !File.Exists(Path.Combine(folder.FullName, "docs", "SCENES.md")))
        {
            folder = folder.Parent;
        }

        return File.ReadAllText(Path.Combine(folder!.FullName, "docs", "SCENES.md")).ReplaceLineEndings("\n");
    }
}
