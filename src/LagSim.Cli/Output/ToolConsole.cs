using System;
using System.IO;
using LagSim.Time;
using Spectre.Console;

namespace LagSim.Cli.Output;

/// <summary>Where results and progress go.</summary>
internal sealed class ToolConsole
{
    private const int WidthOfAFile = 150;

    internal ToolConsole(TextWriter output, TextWriter error)
    {
        Output = output;
        Error = error;
        bool isTerminal = ReferenceEquals(output, Console.Out) && !Console.IsOutputRedirected;
        Rich = AnsiConsole.Create(new AnsiConsoleSettings
        {
            Out = new AnsiConsoleOutput(output),
            Ansi = isTerminal ? AnsiSupport.Detect : AnsiSupport.No,
            ColorSystem = isTerminal ? ColorSystemSupport.Detect : ColorSystemSupport.NoColors,
        });
        if (!isTerminal)
        {
            Rich.Profile.Width = WidthOfAFile; // else a table in a file is broken to 80 columns
        }
    }

    /// <summary>Results, as plain text.</summary>
    internal TextWriter Output { get; }

    /// <summary>Progress and log.</summary>
    internal TextWriter Error { get; }

    /// <summary>Results, as tables.</summary>
    internal IAnsiConsole Rich { get; }

    /// <summary>Runs something long, with a bar on the error stream where that is a terminal, else a line at the start.</summary>
    internal T WithProgress<T>(string title, SimDuration length, Func<Action<SimDuration>?, T> work)
    {
        IAnsiConsole bars = AnsiConsole.Create(new AnsiConsoleSettings { Out = new AnsiConsoleOutput(Error) });
        if (!ReferenceEquals(Error, Console.Error) || Console.IsErrorRedirected)
        {
            Error.WriteLine($"{title} ...");
            return work(null);
        }

        return bars.Progress()
            .Columns(new TaskDescriptionColumn(), new ProgressBarColumn(), new PercentageColumn(), new RemainingTimeColumn())
            .Start(progress =>
            {
                ProgressTask task = progress.AddTask(Markup.Escape(title), maxValue: length.ToSeconds());
                T result = work(done => task.Value = done.ToSeconds());
                task.Value = task.MaxValue;
                return result;
            });
    }
}
