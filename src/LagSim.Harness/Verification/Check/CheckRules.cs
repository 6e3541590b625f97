using System.Collections.Generic;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Testing.Links;

namespace LagSim.Harness.Verification.Check;

/// <summary>The rules of a seeded session, and the commands that players give them.</summary>
/// <remarks>Drawn from streams of their own, and in some sessions only, so that all others stay the same.</remarks>
internal sealed class CheckRules
{
    private const double SomePercent = 15;
    private const int FewestCommands = 4;
    private const int MaxCommands = 12;
    private const ulong FirstCommands = 1000;

    private readonly SeededRandom random;
    private readonly ulong seed;

    internal CheckRules(SeededRandom random, SeededRandom ofVisits, ulong seed, RulesOfSessions which)
    {
        this.random = random;
        this.seed = seed;
        Exist = random.Fork(0).IsLucky(SomePercent) ? which != RulesOfSessions.None : which == RulesOfSessions.All;
        Visits = new CheckVisits(ofVisits, mayExist: Exist);
    }

    /// <summary>Whether the session has any.</summary>
    internal bool Exist { get; }

    /// <summary>Whether they hear of players, and who of these leaves and comes back then.</summary>
    internal CheckVisits Visits { get; }

    /// <summary>Returns a scene with the session's rules.</summary>
    internal Scene On(Scene scene) => Exist ? scene.With(new DrawnRules(seed, Visits.Exist), seed) : scene;

    /// <summary>Adds commands, often in the instant of another action.</summary>
    internal void AddTo(List<CheckAction> actions, CheckScene room, int players, ulong attempt)
    {
        if (!Exist)
        {
            return;
        }

        SeededRandom from = random.Fork(FirstCommands + attempt);
        List<CheckAction> all = [.. actions];
        int commands = FewestCommands + from.NextInt(MaxCommands - FewestCommands + 1);
        for (int i = 0; i < commands; i++)
        {
            double at = from.IsLucky(40) ? from.Pick([.. actions]).AtSeconds : from.NextDouble() * room.BusySeconds;
            byte[] data = new byte[from.NextInt(from.IsLucky(10) ? GameCommand.MaxBytes : 8)];
            for (int n = 0; n < data.Length; n++)
            {
                data[n] = (byte)from.NextInt(256);
            }

            all.Add(new CheckAction(
                at, from.NextInt(players), EventKind.Command, -1, -1, default, default, default, Command: new GameCommand(from.NextInt(5), data)));
        }

        CheckHands.PutInOrder(actions, all);
    }
}
