using System;
using System.IO;
using System.Linq;
using System.Text;
using FsCheck;
using FsCheck.Fluent;
using LagSim.Harness.SceneFiles;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Scenes;

public sealed class SceneFileRoundTripTests
{
    [Fact]
    public void ToJson_AnyScene_ReadsBackAsTheSameWorld() => Prop.ForAll(SceneGen.Any.ToArbitrary(), scene =>
    {
        string json = SceneFile.ToJson(scene);
        Scene again = SceneText.Parse(json);
        return again.Hash == scene.Hash && again.Name == scene.Name && NamesOf(again).SequenceEqual(NamesOf(scene)) && SceneFile.ToJson(again) == json;
    }).Check(Config.QuickThrowOnFailure.WithMaxTest(2000));

    [Fact]
    public void AddPlane_ItsOwnNormalAndOffset_GiveItBackToTheBit() => Prop.ForAll(SceneGen.Plane.ToArbitrary(), plane =>
    {
        StaticPlane was = new SceneBuilder("s").AddPlane("p", plane.Normal, plane.Point).Build().Planes[0];
        StaticPlane again = new SceneBuilder("s").AddPlane("p", was.Normal, was.Offset).Build().Planes[0];
        return again.Normal.Equals(was.Normal) && again.Offset.Equals(was.Offset);
    }).Check(Config.QuickThrowOnFailure.WithMaxTest(20_000));

    [Fact]
    public void Parse_OffsetAndAnyNormal_IsTheVeryOffset() => Prop.ForAll(SceneGen.Plane.ToArbitrary(), plane =>
    {
        Scene scene = SceneText.Parse(SceneText.With(FormattableString.Invariant(
            $"\"planes\": [{{\"name\": \"p\", \"normal\": [{plane.Normal.X:R}, {plane.Normal.Y:R}, {plane.Normal.Z:R}], \"offset_m\": {plane.Point.X:R}}}]")));
        return scene.Planes[0].Offset == plane.Point.X && scene.Planes[0].Normal == new SceneBuilder("s").AddPlane("p", plane.Normal, 0).Build().Planes[0].Normal;
    }).Check(Config.QuickThrowOnFailure.WithMaxTest(5000));

    [Fact]
    public void ToJson_Drop_IsReadyToEdit() => Assert.Equal(
        """
        {
          "format": "lagsim-scene-1",
          "name": "drop",
          "gravity_m_per_s2": [0, -9.81, 0],
          "resolution_m": 1E-09,
          "contact_tolerance_m": 0.001,
          "planes": [
            {
              "name": "floor",
              "normal": [0, 1, 0],
              "offset_m": 0,
              "restitution": 1
            }
          ],
          "static_spheres": [],
          "bodies": [
            {
              "name": "ball",
              "radius_m": 0.5,
              "mass_kg": 1,
              "restitution": 0.8,
              "position_m": [0, 10, 0],
              "velocity_m_per_s": [0, 0, 0],
              "motion": "rk4",
              "step_s": 0.005
            }
          ]
        }

        """.ReplaceLineEndings("\n"),
        SceneFile.ToJson(BuiltInScenes.Drop()));

    [Fact]
    public void ToJson_Rights_AreWrittenWhereNotEveryoneHasThemAndReadBack()
    {
        Scene scene = SceneText.Parse(SceneText.With("\"spawners\": [], \"bodies\": [" + SceneText.Ball.Replace("0.8", "0.8, \"players\": [2, 0]") + "]"));
        Assert.Equal((PeerSet.Nobody, PeerSet.Of(0, 2)), (scene.Spawners, scene.Bodies[0].Players));
        string json = SceneFile.ToJson(scene);
        Assert.Contains("\"spawners\": []", json, StringComparison.Ordinal);
        Assert.Contains("\"players\": [0, 2]", json, StringComparison.Ordinal);
    }

    [Fact]
    public void Parse_OnlyWhatIsRequired_TakesTheDocumentedDefaults()
    {
        Scene scene = SceneText.Parse(SceneText.With(
            "\"bodies\": [" + SceneText.Ball + "], \"planes\": [" + SceneText.Floor + "], "
            + "\"static_spheres\": [{\"name\": \"rock\", \"centre_m\": [5, 0, 0], \"radius_m\": 2}]"));

        Scene expected = new SceneBuilder("other name")
            .WithGravity(new Vector3D(0, -9.81, 0))
            .WithRestitutionThreshold(1e-9)
            .WithContactTolerance(1e-3)
            .AddPlane("floor", Vector3D.Up, Vector3D.Zero, 1)
            .AddStaticSphere("rock", new Vector3D(5, 0, 0), 2, 1)
            .AddBody("ball", new BodySpec(0.5, 1, 0.8, MotionLaw.Ballistic, SimDuration.FromSeconds(0.005)), new Vector3D(0, 10, 0), Vector3D.Zero)
            .Build();
        Assert.Equal(expected.Hash, scene.Hash);
    }

    /// <summary>Open, it follows the smallest radius; set, it is part of what the scene is.</summary>
    [Theory]
    [InlineData("0.5", "", 1e-3)]
    [InlineData("0.02", "", 2e-4)]
    [InlineData("1e-8", "", 1e-9)]
    [InlineData("0.5", "\"smallest_radius_m\": 0.04, ", 4e-4)]
    [InlineData("0.5", "\"contact_tolerance_m\": 1e-6, ", 1e-6)]
    public void Parse_ContactTolerance_IsTheOneSetOrFollowsTheSmallestRadius(string radius, string keys, double metres)
    {
        Scene scene = SceneText.Parse(SceneText.With(keys + "\"bodies\": [" + SceneText.Ball.Replace("0.5", radius) + "]"));

        Assert.Equal(metres, scene.ContactTolerance, 1e-12 * metres);
        Assert.Equal(scene.ContactTolerance, SceneText.Parse(SceneFile.ToJson(scene)).ContactTolerance);
        bool isSet = keys.Contains("tolerance", StringComparison.Ordinal);
        Assert.Equal(isSet, scene.Hash != SceneText.Parse(SceneText.With(
            (isSet ? "" : keys) + "\"bodies\": [" + SceneText.Ball.Replace("0.5", radius) + "]")).Hash);
    }

    [Fact]
    public void Parse_EmptyScene_HasNothingInIt()
    {
        Scene scene = SceneText.Parse("""{"name": "void", "format": "lagsim-scene-1"}""");

        Assert.Empty(scene.Bodies);
        Assert.Equal(new SceneBuilder("void").Build().Hash, scene.Hash);
    }

    [Fact]
    public void Parse_PointOfAPlane_IsAnyPointOfIt() => Assert.Equal(
        2.0,
        SceneText.Parse(SceneText.With("\"planes\": [{\"name\": \"p\", \"normal\": [0, 7, 0], \"point_m\": [9, 2, -4]}]")).Planes[0].Offset);

    [Fact]
    public void ToJson_SuppliedAcceleration_IsRefusedByName()
    {
        Scene scene = new SceneBuilder("windy").AddForce(Force.Supplied(new Wind())).Build();

        SceneFileException refusal = Assert.Throws<SceneFileException>(() => SceneFile.ToJson(scene));
        Assert.Contains("scene 'windy': the scene supplies accelerations written in C#, the first is 'wind'", refusal.Message);
    }

    [Fact]
    public void Write_ThenRead_IsTheSameWorld()
    {
        string path = Path.Combine(Path.GetTempPath(), $"lagsim-scene-{Guid.NewGuid():N}.json");
        try
        {
            SceneFile.Write(BuiltInScenes.Pair(), path);
            Assert.Equal(BuiltInScenes.Pair().Hash, SceneSource.Load(path).Hash);
            Assert.Equal(SceneFile.ToJson(BuiltInScenes.Pair()), File.ReadAllText(path, Encoding.UTF8));
        }
        finally
        {
            File.Delete(path);
        }
    }

    [Fact]
    public void Write_IntoNoFolder_NamesTheFile() => Assert.Contains(
        "cannot be written", Assert.Throws<SceneFileException>(() => SceneFile.Write(BuiltInScenes.Pair(), "no/such/folder/s.json")).Message);

    private static StaticPlane Built(Vector3D normal, Vector3D point) => new SceneBuilder("s").AddPlane("p", normal, point).Build().Planes[0];

    private static string[] NamesOf(Scene scene) =>
        [.. scene.Planes.Select(p => p.Name), .. scene.StaticSpheres.Select(s => s.Name), .. scene.Bodies.Select(b => b.Name)];

    private sealed class Wind : IAcceleration
    {
        public string Name => "wind";

        public int Version => 1;

        public Vector3D At(double seconds, in Vector3D position, in Vector3D velocity) => Vector3D.Up;
    }
}
