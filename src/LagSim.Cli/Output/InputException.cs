using System;

namespace LagSim.Cli.Output;

/// <summary>An input named on the command line cannot be read, used or reached; the message says which and why.</summary>
internal sealed class InputException : Exception
{
    public InputException(string message, Exception? cause = null)
        : base(message, cause)
    {
    }
}
