using System;

namespace LagSim.Cli.Output;

/// <summary>The command line asks for what cannot be; the message names the option and what is allowed.</summary>
internal sealed class UsageException : Exception
{
    public UsageException(string message)
        : base(message)
    {
    }
}
