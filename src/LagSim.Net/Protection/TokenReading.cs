using System;

namespace LagSim.Net.Protection;

/// <summary>What a host read in a connect token.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
public readonly struct TokenReading
{
    /// <summary>Creates the reading of a good token.</summary>
    /// <param name="admission">What it says of the player.</param>
    public TokenReading(PlayerAdmission admission)
    {
        Admission = admission ?? throw new ArgumentNullException(nameof(admission));
        Fault = TokenFault.None;
        Off = TimeSpan.Zero;
    }

    /// <summary>Creates the reading of a token that is not good.</summary>
    /// <param name="fault">What is wrong.</param>
    /// <param name="off">How long ago its time ended, or how long until it begins, by this host's clock.</param>
    public TokenReading(TokenFault fault, TimeSpan off = default)
    {
        Admission = null;
        Fault = fault;
        Off = off;
    }

    /// <summary>What it says of the player; null if it is not good.</summary>
    public PlayerAdmission? Admission { get; }

    /// <summary>What is wrong with it.</summary>
    public TokenFault Fault { get; }

    /// <summary>How long ago its time ended, or how long until it begins, by this host's clock; zero for any other fault.</summary>
    public TimeSpan Off { get; }
}
