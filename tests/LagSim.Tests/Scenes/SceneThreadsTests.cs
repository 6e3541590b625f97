using System;
using System.Collections.Generic;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Scenes;

/// <summary>A large scene is the same on any number of threads, and so is the error where it has one.</summary>
public sealed class SceneThreadsTests
{
    private const int Side = 33; // 35,937 balls, more than twice as many as are worth a second thread
    private static readonly int[] Threads = [1, 2, 3, 7];
    private static readonly BodySpec Ball = new(0.25, 1, 1);

    [Fact]
    public void Build_OnAnyNumberOfThreads_MakesTheSameSceneAndWorld()
    {
        HashSet<(ulong, ulong)> made = [];
        foreach (int threads in Threads)
        {
            made.Add(HashesOf(Grid(moved: -1).WithThreads(threads).Build()));
        }

        Assert.Single(made);
        made.Add(HashesOf(Grid(moved: 30_000).WithThreads(2).Build())); // the control
        Assert.Equal(2, made.Count);
    }

    [Fact]
    public void Build_OverlapsInManyPlaces_NamesTheSameTwoOnAnyNumberOfThreads()
    {
        Random random = new(5);
        HashSet<string> all = [];
        for (int round = 0; round < 6; round++)
        {
            int count = 1 + random.Next(4);
            int[] doubled = new int[count];
            for (int n = 0; n < count; n++)
            {
                doubled[n] = random.Next(Side * Side * Side);
            }

            HashSet<string> errors = ErrorsOf(builder => Array.ForEach(doubled, n => builder.AddBody($"other {n}", Ball, PlaceOf(n) + V(0.1))));
            Assert.Contains("starts", Assert.Single(errors), StringComparison.Ordinal);
            all.UnionWith(errors);
        }

        Assert.True(all.Count >= 5, $"{all.Count} errors of 6 scenes"); // the control: other overlaps, other names
    }

    [Theory]
    [InlineData("overlap", "name", "Two parts")]
    [InlineData("overlap", "speed", "velocity")]
    [InlineData("name", "speed", "velocity")]
    [InlineData("speed", "mass", "mass")]
    [InlineData("floor", "overlap", "floor")]
    [InlineData("overlap", "overlap", "deep inside body")]
    public void Build_TwoErrors_TellsTheOneThatOneThreadTells(string early, string late, string told)
    {
        HashSet<string> errors = ErrorsOf(
            builder =>
            {
                Spoil(builder, late, 0);
                builder.AddPlane("floor", V(0, 1), -100.0);
                Spoil(builder, early, 1);
            });
        Assert.Contains(told, Assert.Single(errors), StringComparison.Ordinal);
    }

    [Theory]
    [InlineData(0)]
    [InlineData(-1)]
    [InlineData(65)]
    public void Build_SoManyThreads_IsRefusedInWords(int threads) =>
        Assert.Contains(
            $"{threads} threads; 1 to 64", Assert.Throws<SceneException>(() => new SceneBuilder("few").WithThreads(threads).Build()).Message, StringComparison.Ordinal);

    private static (ulong Scene, ulong World) HashesOf(Scene scene) => (scene.Hash, new Simulation(scene).EventHash(SimTime.Zero));

    private static HashSet<string> ErrorsOf(Action<SceneBuilder> spoil)
    {
        HashSet<string> errors = [];
        foreach (int threads in Threads)
        {
            SceneBuilder builder = Grid(moved: -1).WithThreads(threads);
            spoil(builder);
            errors.Add(Assert.Throws<SceneException>(() => builder.Build()).Message);
        }

        return errors;
    }

    private static void Spoil(SceneBuilder builder, string how, int n) => _ = how switch
    {
        "overlap" => builder.AddBody($"inside {n}", Ball, PlaceOf(12_000 * (n + 1)) + V(0.1)),
        "name" => builder.AddBody("ball 77", Ball, V(-10 - n, 0)),
        "speed" => builder.AddBody($"fast {n}", Ball, V(-10 - n, 0), V(1e300)),
        "mass" => builder.AddBody($"light {n}", new BodySpec(0.25, 0, 1), V(-10 - n, 0)),
        _ => builder.AddBody($"below {n}", Ball, V(-10 - n, -100)),
    };

    private static SceneBuilder Grid(int moved)
    {
        SceneBuilder builder = new SceneBuilder("grid").WithGravity(V(0));
        for (int n = 0; n < Side * Side * Side; n++)
        {
            builder.AddBody($"ball {n}", Ball, PlaceOf(n) + V(n == moved ? 1e-9 : 0), V(0, n % 7, n % 5));
        }

        return builder;
    }

    private static Vector3D PlaceOf(int n) => V(n % Side, n / Side % Side, n / (Side * Side));
}
