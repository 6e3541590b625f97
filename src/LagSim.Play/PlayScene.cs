using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.SceneFiles;
using LagSim.Scenes;

namespace LagSim.Play;

/// <summary>A scene of the page, and the rectangle of it that is drawn.</summary>
/// <remarks>Immutable. All bodies stay in the plane that is drawn: nothing pushes them out of it.</remarks>
internal sealed class PlayScene
{
    private const int RoomBalls = 16;

    private readonly bool isFromAbove;

    private PlayScene(Scene scene, bool isFromAbove, double left, double bottom, double right, double top)
    {
        Scene = scene;
        this.isFromAbove = isFromAbove;
        (Left, Bottom, Right, Top) = (left, bottom, right, top);
    }

    /// <summary>The names, as a link to the page has them.</summary>
    internal static IReadOnlyList<string> Names { get; } = ["room", "drop", "billiards", "break", "cradle", "orbits", AirHockeyGame.Name];

    /// <summary>The scene.</summary>
    internal Scene Scene { get; }

    /// <summary>The left edge of what is drawn, in metres.</summary>
    internal double Left { get; }

    /// <summary>The lower edge, in metres.</summary>
    internal double Bottom { get; }

    /// <summary>The right edge, in metres.</summary>
    internal double Right { get; }

    /// <summary>The upper edge, in metres.</summary>
    internal double Top { get; }

    /// <summary>Whether it is air hockey: then hands are those of its players.</summary>
    internal bool IsAirHockey { get; private init; }

    /// <summary>Returns the scene of that name.</summary>
    /// <param name="name">One of <see cref="Names"/>.</param>
    /// <param name="players">How many play, where it is a game.</param>
    /// <param name="seed">What its random numbers begin with, where it has some.</param>
    /// <exception cref="ArgumentException">There is none; the message lists those that there are.</exception>
    internal static PlayScene Named(string name, int players = 2, ulong seed = 1) => name switch
    {
        "room" => new PlayScene(Room(), isFromAbove: false, -4.4, -0.4, 4.4, 5.6),
        "drop" => new PlayScene(BuiltInScenes.Drop(), isFromAbove: false, -8, -0.6, 8, 11),
        "billiards" => new PlayScene(BuiltInScenes.Billiards(), isFromAbove: true, -1.33, -0.7, 1.33, 0.7),
        "break" => new PlayScene(BuiltInScenes.Billiards(breakSpeed: 0), isFromAbove: true, -1.33, -0.7, 1.33, 0.7),
        "cradle" => new PlayScene(BuiltInScenes.Cradle(), isFromAbove: false, -4.8, -0.4, 4.8, 4),
        "orbits" => new PlayScene(Orbits(), isFromAbove: false, -6, -4.5, 6, 4.5),
        AirHockeyGame.Name => OfAirHockey(AirHockeyGame.Build(players, seed)),
        _ => throw new ArgumentException($"There is no scene '{name}'; there are {string.Join(", ", Names)}."),
    };

    /// <summary>Any scene, as it is best looked at: from above if its bodies lie on a floor, and so much of it as its bodies are in.</summary>
    internal static PlayScene Of(Scene scene)
    {
        if (AirHockeyGame.IsOf(scene))
        {
            return OfAirHockey(scene);
        }

        foreach (string name in Names)
        {
            if (Named(name) is PlayScene known && known.Scene.Hash == scene.Hash)
            {
                return known;
            }
        }

        Vector3D[] places = [.. scene.Bodies.Select(body => body.Position)];
        double margin = scene.Bodies.Select(body => 3 * body.Spec.Radius).Append(1).Max();
        (double low, double high) x = Span(places, place => place.X, margin), y = Span(places, place => place.Y, margin), z = Span(places, place => place.Z, margin);
        bool isFromAbove = z.high - z.low > y.high - y.low;
        return isFromAbove ? new PlayScene(scene, true, x.low, -z.high, x.high, -z.low) : new PlayScene(scene, false, x.low, y.low, x.high, y.high);
    }

    /// <summary>Where a place is drawn.</summary>
    internal (double X, double Y) ToView(in Vector3D place) => isFromAbove ? (place.X, -place.Z) : (place.X, place.Y);

    /// <summary>The place at a point of the view; as deep in the view as <paramref name="like"/>.</summary>
    internal Vector3D FromView(double x, double y, in Vector3D like) =>
        isFromAbove ? new Vector3D(x, like.Y, -y) : new Vector3D(x, y, like.Z);

    private static PlayScene OfAirHockey(Scene table) => new(
        table, isFromAbove: true, -AirHockeyGame.HalfViewLength, -AirHockeyGame.HalfViewWidth, AirHockeyGame.HalfViewLength, AirHockeyGame.HalfViewWidth)
    {
        IsAirHockey = true,
    };

    private static (double Low, double High) Span(Vector3D[] places, Func<Vector3D, double> along, double margin) =>
        places.Length == 0 ? (-margin, margin) : (places.Min(along) - margin, places.Max(along) + margin);

    /// <summary>Sixteen balls of three sizes above the floor of a walled room.</summary>
    private static Scene Room()
    {
        SceneBuilder builder = new SceneBuilder("room")
            .AddPlane("floor", Vector3D.Up, Vector3D.Zero, 0.9)
            .AddPlane("left wall", new Vector3D(1, 0, 0), -4, 0.9)
            .AddPlane("right wall", new Vector3D(-1, 0, 0), -4, 0.9)
            .AddPlane("ceiling", -Vector3D.Up, -5.2, 0.9);
        for (int n = 0; n < RoomBalls; n++)
        {
            double radius = 0.2 + (0.06 * (n % 3));
            builder.AddBody(
                FormattableString.Invariant($"ball {n}"), new BodySpec(radius, radius * radius * 8, 0.9),
                new Vector3D(-3.2 + (2.1 * (n % 4)), 1 + (1.05 * (n / 4)), 0), new Vector3D(n % 5 == 0 ? 1 : -0.4, 0, 0));
        }

        return builder.Build();
    }

    /// <summary>Five bodies on closed orbits about a sun.</summary>
    private static Scene Orbits()
    {
        const double strength = 12;
        SceneBuilder builder = new SceneBuilder("orbits")
            .WithGravity(Vector3D.Zero)
            .AddForce(Force.Central("pull", Vector3D.Zero, strength), out ForceSet sun)
            .AddStaticSphere("sun", Vector3D.Zero, 0.4, 0.8);
        for (int n = 0; n < 5; n++)
        {
            double far = 1.3 + (0.6 * n);
            double round = Math.Sqrt(strength / far) * (n % 2 == 0 ? 1 : 0.9);
            Vector3D place = n % 2 == 0 ? new Vector3D(far, 0, 0) : new Vector3D(-far, 0, 0);
            Vector3D velocity = n % 2 == 0 ? new Vector3D(0, round, 0) : new Vector3D(0, -round, 0);
            builder.AddBody(FormattableString.Invariant($"planet {n}"), new BodySpec(0.16, 1, 0.9, forces: sun), place, velocity);
        }

        return builder.Build();
    }
}
