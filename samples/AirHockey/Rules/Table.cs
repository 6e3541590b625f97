using System;
using LagSim.Rules;
using LagSim.Scenes;

namespace AirHockey;

/// <summary>The table: where its walls and goals are, who stands where, and what collides with what. In metres, in the plane y = 0.
/// </summary>
/// <remarks>
/// There are no finite walls. So both ends are whole planes, and the rules make the holes: at a goal's mouth is a sensor, and a puck that
/// is inside of it does not collide with the end. Two posts keep it from getting out of the mouth sideways while it is in the plane.
/// </remarks>
public static class Table
{
    public const int MinPlayers = 2;
    public const int MaxPlayers = 4;

    public const double HalfLength = 1.2;
    public const double HalfWidth = 0.6;
    public const double CornerRadius = 0.3;
    public const double PuckRadius = 0.05;
    public const double MalletRadius = 0.09;
    public const double PostRadius = 0.03;
    public const double HalfMouth = 0.23; // to the middle of a post

    public const double Slow = 0.1; // m/s: below it a puck is served again
    private const double Walls = 0.85; // their restitution; of two that meet the lesser counts

    // The sensors, by index: goals and mouths first of the left, then of the right.
    public const int Goals = 0;
    public const int Mouths = 2;
    public const int RightHalf = 4;
    public const int Inside = 5;

    // What a body is, by its tag; a prize has that of what it gives.
    public const ulong PuckTag = 1;
    public const ulong MalletTag = 2;
    public const ulong PrizeTag = 16;

    private const uint Sides = 1, Ends = 2, Pucks = 4, Mallets = 8, Prizes = 16;

    /// <summary>A puck that plays, one that nobody touches before play begins, and one in the mouth of a goal.</summary>
    public static readonly CollisionFilter PuckOnTable = new(Pucks, ~Prizes);
    public static readonly CollisionFilter PuckThatWaits = new(Pucks, 0);
    public static readonly CollisionFilter PuckInMouth = new(Pucks, ~(Prizes | Ends));

    /// <summary>A mallet in its own half, and one beyond the middle line, where it touches no puck.</summary>
    public static readonly CollisionFilter MalletAtHome = new(Mallets);
    public static readonly CollisionFilter MalletBeyond = new(Mallets, Sides | Ends);

    public static readonly BodySpec PuckSpec = new(PuckRadius, mass: 0.1, restitution: 1, filter: PuckOnTable, tag: PuckTag);
    public static readonly BodyId Puck = BodyId.OfScene(0);

    private static readonly (int Degrees, double Cos, double Sin)[] Corners = [(30, Math.Sqrt(0.75), 0.5), (60, 0.5, Math.Sqrt(0.75))];

    private static readonly BodySpec MalletSpec = new(MalletRadius, mass: 0.4, restitution: 0.4, filter: MalletAtHome, tag: MalletTag);

    public static BodyId MalletOf(int player) => BodyId.OfScene(1 + player);

    public static bool IsMallet(BodyId body) => body.Peer == 0 && body.Sequence == 0 && body != Puck;

    public static int PlayerOf(BodyId mallet) => mallet.Index - 1;

    /// <summary>0 for the left side, 1 for the right. Players take turns.</summary>
    public static int SideOf(int player) => player % 2;

    public static CollisionFilter FilterOf(BodyId mallet, bool isRight) =>
        isRight == (SideOf(PlayerOf(mallet)) == 1) ? MalletAtHome : MalletBeyond;

    public static int PlayersOf(Scene scene) => scene.Bodies.Count - 1;

    public static BodySpec Prize(PrizeKind kind) => new(
        PuckRadius, mass: 0.01, restitution: 0, filter: new CollisionFilter(Prizes, Mallets), tag: PrizeTag + (ulong)kind);

    public static bool IsPrize(in BodySpec spec) => spec.Tag >= PrizeTag;

    public static PrizeKind KindOf(in BodySpec prize) => (PrizeKind)(prize.Tag - PrizeTag);

    /// <summary>A place for a prize, away from walls and goals, of two numbers from 0 to 1.</summary>
    public static Vector3D Somewhere(double x, double z) => new((x - 0.5) * HalfLength, 0, (z - 0.5) * HalfWidth);

    /// <summary>Where a mallet begins: players of one side stand beside each other.</summary>
    public static Vector3D HomeOf(int player, int players)
    {
        bool isAlone = players - SideOf(player) <= 2;
        return new Vector3D(SideOf(player) == 0 ? -0.9 : 0.9, 0, isAlone ? 0 : player < 2 ? -0.25 : 0.25);
    }

    /// <summary>The number of the peer that a player is: the host is the first, or, where nobody plays at it, the first client.</summary>
    public static byte PeerOf(Scene scene, int player) =>
        (byte)(player + (scene.Bodies[MalletOf(0).Index].Players == PeerSet.Of(0) ? 0 : 1));

    /// <summary>The scene for so many players.</summary>
    /// <param name="players">How many play.</param>
    /// <param name="rules">The game's rules.</param>
    /// <param name="seed">Of prizes and serves.</param>
    /// <param name="isDedicated">Whether nobody plays at the host.</param>
    public static Scene Build(int players, GameRules rules, ulong seed, bool isDedicated = false)
    {
        SceneBuilder table = new SceneBuilder("air hockey")
            .WithRules(rules)
            .WithSeed(seed)
            .WithGravity(Vector3D.Zero) // nothing ever leaves the plane, so nothing has to fall on it
            .WithSpawners(PeerSet.Nobody)
            .WithSmallestRadius(PuckRadius)
            .AddBody("puck", PuckSpec, Vector3D.Zero, players: PeerSet.Nobody);
        for (int player = 0; player < players; player++)
        {
            table.AddBody($"mallet {player}", MalletSpec, HomeOf(player, players), players: PeerSet.Of(player + (isDedicated ? 1 : 0)));
        }

        AddWalls(table);
        AddSensors(table);
        return table.Build();
    }

    private static void AddWalls(SceneBuilder table)
    {
        foreach (int z in (int[])[-1, 1])
        {
            Wall(z < 0 ? "far side" : "near side", new Vector3D(0, 0, z), new Vector3D(0, 0, z * HalfWidth));
            foreach (int x in (int[])[-1, 1])
            {
                foreach ((int angle, double cos, double sin) in Corners)
                {
                    // Touches the circle of the corner, as the other walls do.
                    Vector3D outwards = new(x * cos, 0, z * sin);
                    Vector3D middle = new(x * (HalfLength - CornerRadius), 0, z * (HalfWidth - CornerRadius));
                    Wall($"corner {x} {z} {angle}", outwards, middle + (outwards * CornerRadius));
                }

                table.AddStaticSphere($"post {x} {z}", new Vector3D(x * HalfLength, 0, z * HalfMouth), PostRadius, Walls, friction: 0);
            }
        }

        foreach (int x in (int[])[-1, 1])
        {
            Wall(x < 0 ? "left end" : "right end", new Vector3D(x, 0, 0), new Vector3D(x * HalfLength, 0, 0), new CollisionFilter(Ends));
        }

        void Wall(string name, Vector3D outwards, Vector3D point, CollisionFilter filter = default) =>
            table.AddPlane(name, -outwards, point, Walls, friction: 0, filter);
    }

    private static void AddSensors(SceneBuilder table)
    {
        // Where a puck touches the end, the boundary of the mouth is at the middle of a post: no puck that passes there touches the end.
        double mouth = Math.Sqrt((HalfMouth * HalfMouth) + (PuckRadius * PuckRadius));
        table
            .AddSensorPlane("left goal", new Vector3D(1, 0, 0), new Vector3D(-HalfLength, 0, 0), SensorCoverage.Whole)
            .AddSensorPlane("right goal", new Vector3D(-1, 0, 0), new Vector3D(HalfLength, 0, 0), SensorCoverage.Whole)
            .AddSensorSphere("left mouth", new Vector3D(-HalfLength, 0, 0), mouth)
            .AddSensorSphere("right mouth", new Vector3D(HalfLength, 0, 0), mouth)
            .AddSensorPlane("right half", new Vector3D(-1, 0, 0), Vector3D.Zero)
            .AddSensorSphere("table", Vector3D.Zero, 1.5 * HalfLength);
    }
}
