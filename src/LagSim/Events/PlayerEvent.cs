using System;
using System.Globalization;
using System.Text;
using LagSim.Time;

namespace LagSim.Events;

/// <summary>What the host says of a player to the game's rules: it joined, is away, returned or left.</summary>
/// <remarks>
/// <para>In a session the host says so by itself, by an event of its own that heals like all, if the scene's rules hear it
/// (<see cref="Scenes.SceneRules.HearsPlayers"/>). No session takes one from a game or from another peer. A world without a session gets them
/// by <see cref="Stamp"/>.</para>
/// <para>Immutable, safe on any thread.</para>
/// </remarks>
/// <example>
/// How a test of rules says that somebody came:
/// <code>
/// PlayerEvent ann = new(PlayerEventKind.Joined, number: 1, identity: 77, "Ann");
/// world.Submit(ann.Stamp(SimTime.FromSeconds(2), sequence: 1));
/// </code>
/// </example>
public sealed class PlayerEvent : IEquatable<PlayerEvent>
{
    /// <summary>The longest name, in bytes of UTF-8: 64.</summary>
    public const int MaxNameBytes = 64;

    /// <summary>The highest number: 254, since 255 stands for the rules.</summary>
    public const byte MaxNumber = 254;

    /// <summary>Creates an event from its fields.</summary>
    /// <param name="kind">What happened.</param>
    /// <param name="number">The player's number, 0 to <see cref="MaxNumber"/>; 0 is the host.</param>
    /// <param name="identity">Who it is, see <see cref="Identity"/>; not 0.</param>
    /// <param name="name">What it calls itself, up to <see cref="MaxNameBytes"/> bytes of UTF-8 without control characters; may be empty.</param>
    /// <param name="role">As what it takes part.</param>
    /// <exception cref="ArgumentNullException">There is no name.</exception>
    /// <exception cref="ArgumentException">It is no name; the message says why.</exception>
    /// <exception cref="ArgumentOutOfRangeException">Another value is out of its range.</exception>
    public PlayerEvent(PlayerEventKind kind, byte number, ulong identity, string name = "", PeerRole role = PeerRole.Player)
    {
        Kind = kind is >= PlayerEventKind.Joined and <= PlayerEventKind.Left
            ? kind : throw new ArgumentOutOfRangeException(nameof(kind), (byte)kind, "What happened is 1 to 4: joined, away, returned or left.");
        Number = number <= MaxNumber
            ? number : throw new ArgumentOutOfRangeException(nameof(number), number, "A player's number is 0 to 254; 255 stands for the rules.");
        Identity = identity != 0
            ? identity : throw new ArgumentOutOfRangeException(nameof(identity), identity, "An identity is 1 or more; 0 is nobody's.");
        Name = WhyNoName(name ?? throw new ArgumentNullException(nameof(name))) is string why
            ? throw new ArgumentException($"A player's name {why}.", nameof(name)) : name;
        Role = role is >= PeerRole.Player and <= PeerRole.Bot
            ? role : throw new ArgumentOutOfRangeException(nameof(role), (byte)role, "A role is 1 to 3: player, spectator or bot.");
    }

    /// <summary>What happened.</summary>
    public PlayerEventKind Kind { get; }

    /// <summary>
    /// The player's number: 0 for the host, then players and bots, then spectators. Somebody else may have it once the player has left.
    /// </summary>
    public byte Number { get; }

    /// <summary>
    /// Who it is: a number that stays the same while the session lasts, also if the player leaves and comes back, and that no other player of
    /// the session gets. Never 0.
    /// </summary>
    /// <remarks>
    /// The host knows a player again by its connect token, its own key or its pass; one who shows none of these is another person. The number
    /// reveals nothing of what it was made from. In another session, or with a host that was started again, it is another.
    /// </remarks>
    public ulong Identity { get; }

    /// <summary>What it calls itself; may be empty, and is not proved unless the host admits by connect tokens.</summary>
    public string Name { get; }

    /// <summary>As what it takes part.</summary>
    public PeerRole Role { get; }

    /// <summary>The event that a world without a session takes: an event of the host, peer 0.</summary>
    /// <param name="time">When it is heard.</param>
    /// <param name="sequence">The number of the event among those of peer 0, which counts its actions too, from 1.</param>
    public ExternalEvent Stamp(SimTime time, uint sequence) => ExternalEvent.OfPlayer(time, sequence, this);

    /// <inheritdoc/>
    public bool Equals(PlayerEvent? other) => other is not null && Kind == other.Kind && Number == other.Number && Identity == other.Identity
        && Role == other.Role && string.Equals(Name, other.Name, StringComparison.Ordinal);

    /// <inheritdoc/>
    public override bool Equals(object? obj) => Equals(obj as PlayerEvent);

    /// <inheritdoc/>
    public override int GetHashCode() => Identity.GetHashCode() ^ ((int)Kind << 8) ^ Number;

    /// <summary>What happened, and to whom.</summary>
    public override string ToString() => string.Format(
        CultureInfo.InvariantCulture, "{0} of {1} {2}{3}{4}", Kind, Role.ToString().ToLowerInvariant(), Number, Name.Length > 0 ? " " : "", Name);

    /// <summary>What is wrong with a name, as the rest of a sentence; null if nothing is.</summary>
    private static string? WhyNoName(string name)
    {
        for (int at = 0; at < name.Length; at++)
        {
            if (char.IsControl(name[at]))
            {
                return FormattableString.Invariant($"has no control character; this one has U+{(int)name[at]:X4}");
            }

            if (char.IsSurrogatePair(name, at))
            {
                at++;
            }
            else if (char.IsSurrogate(name[at]))
            {
                return "has no half of a surrogate pair, which is no character; this one has";
            }
        }

        int bytes = Encoding.UTF8.GetByteCount(name);
        return bytes <= MaxNameBytes ? null : FormattableString.Invariant($"takes at most {MaxNameBytes} bytes of UTF-8; '{name}' takes {bytes}");
    }
}
