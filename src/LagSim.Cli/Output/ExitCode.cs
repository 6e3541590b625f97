namespace LagSim.Cli.Output;

/// <summary>The exit codes of the tool. Scripts rely on them.</summary>
internal static class ExitCode
{
    internal const int Done = 0;

    /// <summary>A check failed, or a strategy that promises agreement did not agree.</summary>
    internal const int CheckFailed = 1;

    internal const int Usage = 2;

    /// <summary>An input is invalid, or could not be read, written, reached or processed.</summary>
    internal const int Input = 3;

    /// <summary>The terminal was closed, as shells report it.</summary>
    internal const int HungUp = 129;

    /// <summary>Ctrl-C, as shells report it: 128 and the number of the signal.</summary>
    internal const int Interrupted = 130;

    /// <summary>The reader of the results has closed the pipe.</summary>
    internal const int ClosedPipe = 141;

    /// <summary>A request to terminate.</summary>
    internal const int Terminated = 143;
}
