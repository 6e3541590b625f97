using System;
using System.Collections.Generic;
using LagSim.Scenes;

namespace LagSim.Net.Sessions;

/// <summary>
/// How a client takes part: who it was before, what it can supply, and what <see cref="SessionOptions"/> has for every peer.
/// </summary>
/// <remarks>
/// Immutable, safe on any thread. Validated when the session is made, with a sentence that names the value and what is allowed.
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

    /// <summary>A client that takes what its host has.</summary>
    public ClientOptions()
    {
    }

    private ClientOptions(SessionOptions common)
        : base(common)
    {
    }

    /// <summary>
    /// What shows the host that this is a player it had before, from <see cref="ClientSession.Pass"/> of then; default none. With one a
    /// client asks for <see cref="SessionOptions.RejoinTime"/> to be let in, as one does that lost its host.
    /// </summary>
    /// <remarks>
    /// A host that does not know it, or no longer, gives the client a number as it gives anybody; one that was started anew the same
    /// number, if it is free: without proof, and for its first <see cref="SessionOptions.RejoinTime"/> alone.
    /// </remarks>
    public PlayerPass Pass { get; init; }

    /// <summary>The accelerations that this program can supply to a scene that it gets from the host; default none.</summary>
    /// <remarks>None may be null. The list is copied: what is put into it later changes nothing.</remarks>
    public IReadOnlyList<IAcceleration>? Accelerations
    {
        get => accelerations;
        init => accelerations = value is null ? null : new List<IAcceleration>(value).AsReadOnly();
    }

    /// <summary>
    /// The same options, if they are a client's; else those of a client that has the settings which both sides have, and defaults.
    /// </summary>
    /// <exception cref="ArgumentNullException">There are none.</exception>
    public static ClientOptions From(SessionOptions options) =>
        options as ClientOptions ?? new ClientOptions(options ?? throw new ArgumentNullException(nameof(options)));

    internal override void Check()
    {
        base.Check();
        for (int n = 0; n < accelerations?.Count; n++)
        {
            if (accelerations[n] is null)
            {
                throw new ArgumentException($"Acceleration {n} of {accelerations.Count} is null; each must be one.", nameof(Accelerations));
            }
        }
    }
}
