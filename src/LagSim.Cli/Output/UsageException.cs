using System;

namespace LagSim.Cli.Output;

/// <summary>The command line is invalid; the message names the option and what is allowed.</summary>
internal sealed class UsageException : Exception
{
    public UsageException(string message)
        : base(message)
    {
    }
}
