using System;
using System.Collections.Generic;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Scenes;

namespace LagSim.Net.Sessions;

/// <summary>
/// How a client takes part: its former identity, the accelerations it can supply, and the <see cref="SessionOptions"/> of every peer.
/// </summary>
/// <remarks>
/// Immutable, safe on any thread. Validated when the session is made, with an exception that names the value and what is allowed.
/// </remarks>
/// <example>
/// A client that comes back as the player it was:
/// <code>
/// ClientOptions options = new() { ConnectKey = "correct horse battery staple", Pass = pass };
/// using PeerThread client = PeerThread.Join(address, options, setUp: session =&gt;
///     session.PassGiven += given =&gt; Console.WriteLine($"player {given.Number}"));
/// </code>
/// </example>
public sealed record ClientOptions : SessionOptions
{
    private readonly IReadOnlyList<IAcceleration>? accelerations;
    private readonly IReadOnlyList<SceneRules>? rules;

    /// <summary>Creates the defaults: a new player that takes the host's scene.</summary>
    public ClientOptions()
    {
    }

    private ClientOptions(SessionOptions common)
        : base(common)
    {
    }

    /// <summary>
    /// Proves to the host that this client is a player it had before: the <see cref="ClientSession.Pass"/> of that earlier session; default
    /// none. With a pass, a client asks to be let in for <see cref="SessionOptions.RejoinTime"/>, just like one that lost its host.
    /// </summary>
    /// <remarks>
    /// A host that does not know the pass gives the client a number as it would any other. A host that was restarted gives it its old
    /// number without proof if that is free, but only for its first <see cref="SessionOptions.RejoinTime"/>.
    /// </remarks>
    public PlayerPass Pass { get; init; }

    /// <summary>
    /// Which host the client wants, and its handshake: with it every datagram is encrypted and authenticated, and only a host with
    /// protection is joined. Default null: the session is not protected, and anyone on the path can read, change and forge what is sent.
    /// </summary>
    /// <remarks>Each session needs one of its own. The package <c>LagSim.Net.Secure</c> has it: <c>SecureClient</c>.</remarks>
    public IClientProtection? Protection { get; init; }

    internal override bool IsProtected => Protection is not null;

    /// <summary>
    /// The connect token that a backend issued to this player, for hosts that let in nobody else; default none. It needs a
    /// <see cref="Protection"/> that knows which host it wants: a token must not be told to whoever answers first.
    /// </summary>
    /// <remarks>
    /// It admits once, within its time. A client that loses its host comes back with the pass it has got; after a restart of the host it
    /// needs another token. Up to 256 bytes.
    /// </remarks>
    public ReadOnlyMemory<byte> Token { get; init; }

    /// <summary>The accelerations that this program can supply to the host's scene; default none.</summary>
    /// <remarks>None may be null. The list is copied: later changes to it have no effect.</remarks>
    public IReadOnlyList<IAcceleration>? Accelerations
    {
        get => accelerations;
        init => accelerations = value is null ? null : new List<IAcceleration>(value).AsReadOnly();
    }

    /// <summary>The rules that this program can supply to the host's scene; default none. A scene with others is refused.</summary>
    /// <remarks>None may be null. The list is copied: later changes to it have no effect.</remarks>
    public IReadOnlyList<SceneRules>? Rules
    {
        get => rules;
        init => rules = value is null ? null : new List<SceneRules>(value).AsReadOnly();
    }

    /// <summary>
    /// Other addresses of the host, as a name has in DNS: while none has answered, each is asked besides, a quarter of a second after the one
    /// before it. The first that answers is the host's. Default none.
    /// </summary>
    internal IReadOnlyList<PeerAddress> OtherAddresses { get; init; } = Array.Empty<PeerAddress>();

    /// <summary>What sentences call the host's place; default null: its address, where that says something to a person.</summary>
    internal string? HostName { get; init; }

    /// <summary>
    /// Returns <paramref name="options"/> if they are a client's, otherwise client options with the same shared settings and defaults for
    /// the rest.
    /// </summary>
    /// <exception cref="ArgumentNullException">The options are null.</exception>
    public static ClientOptions From(SessionOptions options) =>
        options as ClientOptions ?? new ClientOptions(options ?? throw new ArgumentNullException(nameof(options)));

    internal override void Check()
    {
        base.Check();
        if (Token.Length > IHostProtection.MaxTokenBytes)
        {
            throw new ArgumentException(
                $"The connect token has {Token.Length} bytes; one has at most {IHostProtection.MaxTokenBytes}.", nameof(Token));
        }

        if (Token.Length > 0 && Protection?.KnowsHost != true)
        {
            throw new ArgumentException(
                "A connect token is only for a client whose protection knows which host it wants; whoever answers first could take it.",
                nameof(Token));
        }

        for (int n = 0; n < rules?.Count; n++)
        {
            if (rules[n] is null)
            {
                throw new ArgumentException($"Of {rules.Count} rules number {n} is null; each must be some.", nameof(Rules));
            }
        }

        for (int n = 0; n < accelerations?.Count; n++)
        {
            if (accelerations[n] is null)
            {
                throw new ArgumentException($"Acceleration {n} of {accelerations.Count} is null; each must be one.", nameof(Accelerations));
            }
        }
    }
}
