using System;
using System.Collections.Generic;
using System.Linq;
using System.Text;
using LagSim.Scenes;
using LagSim.Testing.Invariant;
using LagSim.Time;

namespace LagSim.Testing;

/// <summary>The result of a <see cref="SessionTest"/>: whether all players had the same world, that world to read, and the cost.</summary>
/// <remarks>For one thread, like reading a world.</remarks>
public sealed class SessionTestResult
{
    private const string UsualCauses = "Usual causes: a force, rules or a session option that are not the same for every player,"
        + " or that read a clock, a random number or anything else outside the world.";

    private readonly Comparison comparison;
    private readonly string? promise;

    internal SessionTestResult(
        Simulation world, ulong seed, double seconds, Comparison comparison, IReadOnlyList<PlayerResult> players, string? promise)
    {
        World = world;
        Seed = seed;
        Seconds = seconds;
        this.comparison = comparison;
        this.promise = promise;
        Players = players;
    }

    /// <summary>The seed of the run.</summary>
    public ulong Seed { get; }

    /// <summary>The length of play, in seconds since the start of the world.</summary>
    public double Seconds { get; }

    /// <summary>The players, the host first.</summary>
    public IReadOnlyList<PlayerResult> Players { get; }

    /// <summary>
    /// The world that had every accepted event before anything was simulated, which every player's world must equal. It keeps all of its
    /// past, and has been advanced to <see cref="Seconds"/> at least.
    /// </summary>
    public Simulation World { get; }

    /// <summary>
    /// Whether every player's world equals <see cref="World"/> bit for bit, at every time that it still kept or had committed.
    /// </summary>
    public bool WorldsAgree => comparison.Differing == 0;

    /// <summary>
    /// The first event in which a player differed; null if there is none, or the players no longer keep it (<see cref="ToString"/> then
    /// names the state).
    /// </summary>
    public FirstDifference? FirstDifference => comparison.First;

    /// <summary>The number of states, hashes and events compared.</summary>
    public long Compared => comparison.Compared;

    /// <summary>The number of those that differ in any bit.</summary>
    public long Differing => comparison.Differing;

    /// <summary>The number of events that the host accepted: the players' actions that happened.</summary>
    public long EventsAccepted { get; internal init; }

    /// <summary>The number of events that the host refused, including those too late for the session's window.</summary>
    public long EventsRefused { get; internal init; }

    /// <summary>
    /// The number of events that reached the host too late for the session's window (<see cref="Net.Sessions.SessionOptions.Window"/>).
    /// Their authors saw them retracted.
    /// </summary>
    public long EventsTooLate { get; internal init; }

    /// <summary>
    /// The number of accepted events that reached the host too late for their stamps, and happened later
    /// (<see cref="Net.Wire.Verdict.Moved"/>).
    /// </summary>
    public long EventsMoved { get; internal init; }

    /// <summary>The number of late events, over all players.</summary>
    public long LateEvents => Players.Sum(player => player.LateEvents);

    /// <summary>How often a world was healed for a late event, over all players.</summary>
    public long Heals => Players.Sum(player => player.Heals);

    /// <summary>The number of frames that could not be drawn, over all players.</summary>
    public long StalledFrames => Players.Sum(player => player.StalledFrames);

    /// <summary>The bytes that all players sent, with UDP and IP headers, from connecting to the end.</summary>
    public long BytesSent => Players.Sum(player => player.Traffic.BytesSent);

    /// <summary>
    /// The hash of the world at the end of the run. The same seed gives the same hash on every machine, so a test can pin it.
    /// </summary>
    public ulong StateHash => World.StateHash(At(Seconds));

    /// <summary>The state of a body at the end of the run; absent (<see cref="MotionLaw.Absent"/>) if it is not there.</summary>
    /// <param name="body">The body.</param>
    public BodyState StateOf(BodyId body) => StateOf(body, Seconds);

    /// <summary>The state of a body at a time of the run; absent (<see cref="MotionLaw.Absent"/>) if it is not there.</summary>
    /// <param name="body">The body.</param>
    /// <param name="seconds">Seconds since the start of the world, 0 to <see cref="Seconds"/>.</param>
    /// <exception cref="ArgumentOutOfRangeException">The time is out of range.</exception>
    public BodyState StateOf(BodyId body, double seconds)
    {
        CheckTime(seconds);
        return World.TryRead(body, At(seconds), out BodyState state) ? state : default;
    }

    /// <summary>The world's state of the rules at the end of the run.</summary>
    /// <typeparam name="T">The type that the scene's rules declare.</typeparam>
    /// <exception cref="InvalidOperationException">The scene has no rules, or they declare another type.</exception>
    public T StateOfRules<T>()
        where T : unmanaged => StateOfRules<T>(Seconds);

    /// <summary>The world's state of the rules at a time of the run.</summary>
    /// <typeparam name="T">The type that the scene's rules declare.</typeparam>
    /// <param name="seconds">Seconds since the start of the world, 0 to <see cref="Seconds"/>.</param>
    /// <exception cref="ArgumentOutOfRangeException">The time is out of range.</exception>
    /// <exception cref="InvalidOperationException">The scene has no rules, or they declare another type.</exception>
    public T StateOfRules<T>(double seconds)
        where T : unmanaged
    {
        CheckTime(seconds);
        return World.TryReadRules(At(seconds), out T state) ? state
            : throw new InvalidOperationException($"The scene '{World.Scene.Name}' has no rules.");
    }

    /// <summary>Throws if a state that a player committed, or what its world keeps at the end, differs from <see cref="World"/>.</summary>
    /// <exception cref="WorldsDifferException">A world differed; the message names the first difference.</exception>
    public void ThrowIfWorldsDiffer()
    {
        if (!WorldsAgree)
        {
            throw new WorldsDifferException(ToString(), this);
        }
    }

    /// <summary>Whether the worlds agree, otherwise the first difference; then a line for each player.</summary>
    public override string ToString()
    {
        StringBuilder text = new();
        text.Append(WorldsAgree
            ? FormattableString.Invariant($"All worlds agree: {Compared} states and events compared, no bit differs.")
            : $"Not every player ended up with the same world. {Difference()}");
        text.Append(FormattableString.Invariant($"\nseed {Seed}, {Seconds} s, {EventsAccepted} events accepted, {EventsRefused} refused"));
        text.Append(FormattableString.Invariant($", {EventsTooLate} of them too late"));
        text.Append(EventsMoved == 0 ? "" : FormattableString.Invariant($", {EventsMoved} of the accepted moved to a later time"));
        foreach (PlayerResult player in Players)
        {
            text.Append('\n').Append(player);
        }

        return text.ToString();
    }

    private string Difference()
    {
        string first = comparison.First?.Text(NameOf) ?? comparison.FirstHash ?? "";
        string count = FormattableString.Invariant($"{Differing} of {Compared} compared states and events differ.");
        return $"{first} {count} {promise ?? UsualCauses}";
    }

    private string NameOf(BodyId body)
    {
        bool isOfScene = body.Peer == 0 && body.Sequence == 0 && body.Index < World.Scene.Bodies.Count;
        return isOfScene ? $"'{World.Scene.Bodies[body.Index].Name}'" : body.ToString();
    }

    private void CheckTime(double seconds)
    {
        if (!(seconds >= 0 && seconds <= Seconds))
        {
            throw new ArgumentOutOfRangeException(
                nameof(seconds), seconds, FormattableString.Invariant($"The run lasted from 0 to {Seconds} s."));
        }
    }

    private SimTime At(double seconds) => World.Start + SimDuration.FromSeconds(seconds);
}
