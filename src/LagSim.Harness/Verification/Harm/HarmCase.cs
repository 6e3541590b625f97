using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.SceneFiles;
using LagSim.Scenes;
using LagSim.Testing.Links;

namespace LagSim.Harness.Verification.Harm;

/// <summary>One seeded attack: the scene, the attacker's link, and its actions.</summary>
/// <remarks>
/// Determined by the seed. Attacks stay within limits that hosts had before: 64 bodies, 999 m/s, less than 500 events a second.
/// </remarks>
public sealed class HarmCase
{
    /// <summary>The duration of the attack, in seconds.</summary>
    public const double Seconds = 3;

    private const int MaxBodies = 64;
    private const double MaxSpeed = 999;
    private const double KeyframeSeconds = 0.1;
    private const double PercentOfActs = 30;
    private const double PercentOfRules = 10;

    /// <summary>A mass in kg whose hand, at 1000 N for each kg, does not yield to anything else in the room.</summary>
    private const double AnvilMass = 1e8;

    private const string Anvil = "anvil";

    private static readonly double[] Restitutions = [0, 0.1, 0.2, 0.5, 0.8, 0.95, 0.99, 1, 1];

    private readonly SeededRandom random;
    private readonly List<HarmAction> actions = [];
    private readonly double radius;
    private readonly bool isStrong;
    private int spawns;

    /// <summary>Draws the attack of a seed.</summary>
    public HarmCase(ulong seed)
    {
        Seed = seed;
        random = new SeededRandom(seed).Fork(0x4A12);
        Kind = random.Pick(HarmKind.Gap, HarmKind.Heap, HarmKind.Heap, HarmKind.ShakenHeap, HarmKind.Row, HarmKind.Storm, HarmKind.Scene);
        LinkMilliseconds = random.Pick(5, 20, 50, 150, 400, 900);
        Restitution = random.Pick(Restitutions);
        Friction = random.Pick(0, 0, 0.1, 0.3, 1);
        Width = random.NextDouble(1, 3);
        radius = random.Pick(0.1, 0.2, 0.25);
        isStrong = Kind is HarmKind.Gap or HarmKind.Row or HarmKind.ShakenHeap && new SeededRandom(seed).Fork(0x4A13).IsLucky(70);
        SeededRandom acts = new SeededRandom(seed).Fork(0x4A14); // a stream of its own, so that all other attacks stay the same
        Kind = acts.IsLucky(PercentOfActs) ? acts.Pick(HarmKind.Acts, HarmKind.Acts, HarmKind.Crowd, HarmKind.Fit) : Kind;
        SeededRandom ruled = new SeededRandom(seed).Fork(0x4A15); // so too
        Kind = ruled.IsLucky(PercentOfRules) ? HarmKind.Rules : Kind;
        Scene = Kind switch
        {
            HarmKind.Acts => HarmActs.DrawActs(acts, actions),
            HarmKind.Crowd => HarmActs.DrawCrowd(acts, actions),
            HarmKind.Fit => HarmActs.DrawFit(acts, actions),
            HarmKind.Rules => HarmActs.DrawRules(ruled, seed, actions),
            _ => random.IsLucky(25) ? BuiltIn() : Room(),
        };
        switch (Kind)
        {
            case HarmKind.Acts or HarmKind.Crowd or HarmKind.Fit or HarmKind.Rules:
                break;
            case HarmKind.Gap:
                DrawGaps();
                break;
            case HarmKind.Row:
                DrawRow();
                break;
            case HarmKind.Heap or HarmKind.ShakenHeap:
                DrawHeap(Kind == HarmKind.ShakenHeap);
                break;
            case HarmKind.Storm:
                DrawStorm();
                break;
            default:
                DrawScene();
                break;
        }

        Actions = [.. actions.Where(d => d.AtSeconds < Seconds).OrderBy(d => d.AtSeconds)];
    }

    /// <summary>The seed.</summary>
    public ulong Seed { get; }

    /// <summary>The kind of attack.</summary>
    public HarmKind Kind { get; }

    /// <summary>The scene.</summary>
    public Scene Scene { get; }

    /// <summary>The one-way delay from the attacker to the host, in milliseconds. Its events are that late.</summary>
    public double LinkMilliseconds { get; }

    /// <summary>The restitution of most of the bodies.</summary>
    public double Restitution { get; }

    /// <summary>The friction of most of the bodies.</summary>
    public double Friction { get; }

    /// <summary>Half the width of the room, in metres.</summary>
    public double Width { get; }

    /// <summary>The attacker's actions, in order of time.</summary>
    internal IReadOnlyList<HarmAction> Actions { get; }

    /// <summary>Returns a short description.</summary>
    public override string ToString() => string.Create(
        CultureInfo.InvariantCulture,
        $"{Kind} in {Scene.Name}, restitution {Restitution:0.##}, friction {Friction:0.##}, {Actions.Count(d => d.Kind == EventKind.Spawn)}"
        + $" bodies, {Actions.Count} events, {LinkMilliseconds:0} ms away");

    private Scene BuiltIn()
    {
        BuiltInScenes.TryGet(random.Pick("drop", "pair", "cradle", "billiards"), out Scene? scene);
        return scene!;
    }

    private Scene Room()
    {
        double floor = random.Pick(1, 1, Restitution);
        SceneBuilder builder = new SceneBuilder("room").WithSmallestRadius(0.1)
            .AddPlane("floor", Vector3D.Up, new Vector3D(0, 0, 0), floor, Friction)
            .AddPlane("west", new Vector3D(1, 0, 0), new Vector3D(-Width, 0, 0), 1, 0).AddPlane("east", new Vector3D(-1, 0, 0), new Vector3D(Width, 0, 0), 1, 0)
            .AddPlane("north", new Vector3D(0, 0, 1), new Vector3D(0, 0, -Width), 1, 0).AddPlane("south", new Vector3D(0, 0, -1), new Vector3D(0, 0, Width), 1, 0);
        for (int n = 0; n < 3; n++)
        {
            double mass = n == 0 ? 1 : random.Pick(0.01, 1, 100);
            double e = n == 2 ? random.Pick(Restitutions) : Restitution;
            builder.AddBody($"ball {n}", new BodySpec(radius, mass, e, friction: Friction), new Vector3D((n - 1) * 2.1 * radius, radius + 0.5 + (n * 0.1), 0));
        }

        if (isStrong)
        {
            builder.AddBody(Anvil, new BodySpec(radius, AnvilMass, 1, friction: Friction), new Vector3D(0, radius, 2.5 * radius));
        }

        return builder.Build();
    }

    private int Kindred() => random.IsLucky(70) ? 0 : random.NextInt(Scene.Bodies.Count);

    /// <summary>What a hand holds: where it is to be strong, the heaviest body, because a hand has as much force as that needs.</summary>
    private int Held(int otherwise) => isStrong && Scene.Bodies[^1].Name == Anvil ? Scene.Bodies.Count - 1 : otherwise;

    private double RadiusOf(int body) => Scene.Bodies[body].Spec.Radius;

    private double Fast() => random.IsLucky(60) ? MaxSpeed : LogUniform(1, MaxSpeed);

    private double LogUniform(double low, double high) => low * SeededRandom.Exp(random.NextDouble() * Math.Log(high / low));

    private int Spawn(double at, int like, Vector3D place)
    {
        actions.Add(new HarmAction(at, EventKind.Spawn, -1, like, place));
        return spawns++;
    }

    private void Push(double at, int spawn, Vector3D velocity) =>
        actions.Add(new HarmAction(at, EventKind.SetVelocity, spawn, 0, default, velocity));

    private void Hold(double at, int spawn, Vector3D place, Func<double, Vector3D>? path = null, double every = KeyframeSeconds)
    {
        actions.Add(new HarmAction(at, EventKind.Grab, spawn, 0, default));
        for (double then = at + 0.001; then < Seconds; then += every)
        {
            actions.Add(new HarmAction(then, EventKind.HoldKeyframe, spawn, 0, path?.Invoke(then) ?? place));
        }
    }

    private void DrawGaps()
    {
        int pairs = 1 + random.NextInt(6);
        for (int n = 0; n < pairs; n++)
        {
            int like = Kindred();
            double r = RadiusOf(like), gap = LogUniform(1e-5, 1e-2);
            Vector3D low = Place(n, r);
            Vector3D high = low + new Vector3D(0, (2 * r) + gap, 0);
            double at = random.NextDouble(0, 0.5);
            int held = Spawn(at, Held(like), high), fast = Spawn(at, like, low);
            Hold(at, held, high);
            Push(at + 0.05, fast, new Vector3D(0, Fast(), 0));
            Push(at + random.NextDouble(0.1, 2), fast, new Vector3D(0, Fast(), 0));
        }
    }

    private void DrawRow()
    {
        int count = 3 + random.NextInt(20);
        double gap = LogUniform(1e-6, 1e-2), at = random.NextDouble(0, 0.3);
        int like = Kindred();
        double r = RadiusOf(like);
        bool isUp = random.IsLucky(50);
        for (int n = 0; n < count; n++)
        {
            Vector3D place = isUp ? new Vector3D(Width / 2, r + gap + (n * ((2 * r) + gap)), Width / 2) : new Vector3D(-Width + r + gap + (n * ((2 * r) + gap)), r + 1, Width / 2);
            bool isHeld = n == 0 || n == count - 1;
            int ball = Spawn(at, isHeld ? Held(like) : like, place);
            if (isHeld)
            {
                Hold(at, ball, place);
            }
            else if (random.IsLucky(50))
            {
                Push(at + 0.05, ball, isUp ? new Vector3D(0, Fast(), 0) : new Vector3D(Fast(), 0, 0));
            }
        }
    }

    private void DrawHeap(bool isShaken)
    {
        int count = isShaken || random.IsLucky(70) ? MaxBodies : 8 + random.NextInt(56);
        double spread = random.Pick(0.001, 0.01, 0.2), at = random.NextDouble(0, 0.3), speed = random.Pick(0, 0, 1, 20, Fast());
        double side = Math.Max(1, Math.Floor(((2 * Width) - 0.01) / ((2 * radius) + spread)));
        int wide = (int)Math.Min(side, 2 + random.NextInt(4));
        int last = 0;
        for (int n = 0; n < count; n++)
        {
            int like = Kindred();
            double r = RadiusOf(like), pitch = (2 * r) + spread;
            Vector3D place = new(-Width + r + 0.001 + (pitch * (n % wide)), r + 0.6 + (pitch * (n / (wide * wide))) + (random.NextDouble() * 0.001), -Width + r + 0.001 + (pitch * (n / wide % wide)));
            last = Spawn(at + (n * 0.002), isShaken && n == count - 1 ? Held(like) : like, place);
            if (speed > 0)
            {
                Push(at + 0.2, last, new Vector3D(0, -speed, 0));
            }
        }

        if (isShaken)
        {
            double depth = random.NextDouble(0.05, 0.5), rate = random.NextDouble(1, 20);
            Vector3D middle = new(-Width + (radius * wide), radius + 0.5, -Width + (radius * wide));
            Hold(at + 0.3, last, middle, then => middle + new Vector3D(0, depth * (random.NextDouble() - 0.5), depth * (((int)(then * rate) % 2) - 0.5)), random.Pick(0.005, 0.02, 0.1));
        }
    }

    private void DrawStorm()
    {
        int count = 4 + random.NextInt(60);
        double every = random.Pick(0.0025, 0.005, 0.02);
        Vector3D middle = Place(0, radius) + new Vector3D(0, 1, 0);
        for (int n = 0; n < count; n++)
        {
            Spawn(n * 0.003, Kindred(), middle + new Vector3D(0, n * 0.51, 0));
        }

        for (double at = 0.3; at < Seconds; at += every)
        {
            int which = random.NextInt(count);
            Vector3D place = middle + new Vector3D(random.NextDouble(-0.3, 0.3), random.NextDouble(0, 0.6), random.NextDouble(-0.3, 0.3));
            actions.Add(random.IsLucky(60)
                ? new HarmAction(at, EventKind.Teleport, which, 0, place)
                : new HarmAction(at, EventKind.SetVelocity, which, 0, default, new Vector3D(random.NextDouble(-1, 1), random.NextDouble(-1, 0), random.NextDouble(-1, 1)) * (0.57 * Fast())));
        }
    }

    private void DrawScene()
    {
        double every = random.Pick(0.0025, 0.01, 0.1, 1);
        for (double at = 0; at < Seconds; at += every)
        {
            int body = random.NextInt(Scene.Bodies.Count);
            actions.Add(random.IsLucky(20)
                ? new HarmAction(at, EventKind.Teleport, -1, body, new Vector3D(random.NextDouble(-0.4, 0.4), random.NextDouble(0.6, 3), random.NextDouble(-0.4, 0.4)))
                : new HarmAction(at, EventKind.SetVelocity, -1, body, default, new Vector3D(random.NextDouble(-1, 1), random.NextDouble(-1, 1), random.NextDouble(-1, 1)) * Fast() * 0.57));
        }

        if (random.IsLucky(50))
        {
            DrawHeap(isShaken: false);
        }
    }

    private Vector3D Place(int n, double r) =>
        new(-Width + r + 0.01 + (n % 3 * ((2 * r) + 0.02)), r + 0.0005, Width - r - 0.01 - (n / 3 * ((2 * r) + 0.02)));
}
