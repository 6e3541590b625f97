using System;
using System.Runtime.InteropServices;
using System.Threading;

namespace LagSim.Cli;

/// <summary>
/// Handles Ctrl-C, termination requests and a terminal that was closed: cancels the work, so that the other peers get a goodbye, files end
/// with a whole row and the cursor is shown again.
/// </summary>
internal sealed class Interruption : IDisposable
{
    /// <summary>How long the work has to stop by itself.</summary>
    private static readonly TimeSpan Grace = TimeSpan.FromSeconds(2);

    private readonly CancellationTokenSource asked = new();
    private readonly ManualResetEventSlim stopped = new();
    private readonly PosixSignalRegistration[] registrations;

    internal Interruption() => registrations =
    [
        PosixSignalRegistration.Create(PosixSignal.SIGINT, signal => On(signal, Output.ExitCode.Interrupted)),
        PosixSignalRegistration.Create(PosixSignal.SIGTERM, signal => On(signal, Output.ExitCode.Terminated)),
        PosixSignalRegistration.Create(PosixSignal.SIGHUP, signal => On(signal, Output.ExitCode.HungUp)),
    ];

    /// <summary>The token that cancels a command's work.</summary>
    internal CancellationToken Token => asked.Token;

    /// <summary>The exit code of the signal; null if there was none.</summary>
    internal int? ExitCode { get; private set; }

    public void Dispose()
    {
        stopped.Set();
        foreach (PosixSignalRegistration registration in registrations)
        {
            registration.Dispose();
        }
    }

    private void On(PosixSignalContext signal, int exitCode)
    {
        if (ExitCode is not null)
        {
            return; // a second signal ends the process at once
        }

        ExitCode = exitCode;
        signal.Cancel = true;
        asked.Cancel();
        if (!stopped.Wait(Grace))
        {
            Output.ToolConsole.ShowCursor();
            Environment.Exit(exitCode);
        }
    }
}
