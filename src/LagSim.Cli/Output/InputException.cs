using System;

namespace LagSim.Cli.Output;

/// <summary>What the command line names cannot be read, used or reached; the message says what and why.</summary>
internal sealed class InputException : Exception
{
    public InputException(string message, Exception? cause = null)
        : base(message, cause)
    {
    }
}
