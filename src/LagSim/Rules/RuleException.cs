using System;

namespace LagSim.Rules;

/// <summary>Rules asked for something that they may not do, or more of it than they may. The sentence says what is allowed.</summary>
/// <remarks>Thrown into the call of the rules, which should not catch it: it ends the call, and with it the world, with a
/// <see cref="SimulationException"/> that names the rules, the call and the instant; of a command it may end the call alone
/// (<see cref="GameRules.WithFailedCommandsSkipped"/>).</remarks>
public sealed class RuleException : Exception
{
    /// <summary>No message; prefer the one with a sentence.</summary>
    public RuleException()
    {
    }

    /// <summary>A sentence that names the value and what is allowed.</summary>
    public RuleException(string message)
        : base(message)
    {
    }

    /// <summary>A sentence, and what caused it.</summary>
    public RuleException(string message, Exception innerException)
        : base(message, innerException)
    {
    }
}
