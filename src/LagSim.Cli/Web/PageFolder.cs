using System;
using System.Diagnostics;
using System.IO;
using System.Linq;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Cli.Output;

namespace LagSim.Cli.Web;

/// <summary>The folder with the files of the page: beside a packed tool, or built from a clone when it is asked for.</summary>
internal static class PageFolder
{
    private const string Project = "src/LagSim.Play.Browser/LagSim.Play.Browser.csproj";
    private const int LinesOfAFailure = 12;

    private static readonly TimeSpan Look = TimeSpan.FromMilliseconds(200);

    /// <summary>Returns the folder once it is there.</summary>
    /// <param name="log">Receives what is being done.</param>
    /// <param name="stop">Gives up.</param>
    /// <exception cref="InputException">There is none, or it cannot be built.</exception>
    internal static async Task<string> FindAsync(TextWriter log, CancellationToken stop)
    {
        string beside = Path.Combine(AppContext.BaseDirectory, "page");
        if (File.Exists(Path.Combine(beside, "index.html")))
        {
            return Path.GetFullPath(beside);
        }

        string project = Source()
            ?? throw new InputException(
                $"The page is not beside this tool ({beside}), and it does not run from a clone, in which it could build it.");
        string output = Path.Combine(Path.GetDirectoryName(project)!, "bin", "page"), stamp = output + ".built";
        using (await LockAsync(output + ".lock", stop))
        {
            bool isThere = File.Exists(Path.Combine(output, "wwwroot", "index.html"));
            if (!isThere || !IsNewerThanSources(stamp, Path.GetFullPath(Path.Combine(Path.GetDirectoryName(project)!, "../.."))))
            {
                await log.WriteLineAsync("building the page; the first time it takes about a minute");
                DateTime began = DateTime.UtcNow;
                Clear(stamp, output, Path.Combine(Path.GetDirectoryName(project)!, "obj"));
                await PublishAsync(project, output, stop);
                ThrowIfEmpty(output);
                await File.WriteAllTextAsync(stamp, "", stop);
                File.SetLastWriteTimeUtc(stamp, began);
            }
        }

        return Path.Combine(output, "wwwroot");
    }

    /// <summary>The project of the page in the clone that this program was built in; null if it was not.</summary>
    private static string? Source()
    {
        for (DirectoryInfo? at = new(AppContext.BaseDirectory); at is not null; at = at.Parent)
        {
            string project = Path.Combine(at.FullName, Project);
            if (File.Exists(project))
            {
                return project;
            }
        }

        return null;
    }

    /// <summary>Whether nothing that a page is made of has changed since it was built. To ask the build itself takes ten seconds each time.</summary>
    internal static bool IsNewerThanSources(string stamp, string root)
    {
        DateTime built = File.GetLastWriteTimeUtc(stamp); // long ago if there is none
        string[] made = ["bin", "obj"];
        return Directory.EnumerateFiles(Path.Combine(root, "src"), "*", SearchOption.AllDirectories)
            .Concat(Directory.EnumerateFiles(Path.Combine(root, "samples", "AirHockey"), "*", SearchOption.AllDirectories))
            .Concat(Directory.EnumerateFiles(root))
            .Where(file => !Path.GetRelativePath(root, file).Split(Path.DirectorySeparatorChar).Intersect(made).Any())
            .All(file => File.GetLastWriteTimeUtc(file) < built);
    }

    /// <summary>A build that was cut off leaves files that are empty, which the next one takes for done: those that are compressed, and
    /// those of the page itself.</summary>
    internal static void Clear(string stamp, string output, string made)
    {
        File.Delete(stamp);
        string[] compressed = Directory.Exists(made) ? Directory.GetDirectories(made, "compressed", SearchOption.AllDirectories) : [];
        foreach (string folder in compressed.Append(output).Where(Directory.Exists))
        {
            Directory.Delete(folder, recursive: true);
        }
    }

    /// <exception cref="InputException">A file of the page has nothing in it.</exception>
    internal static void ThrowIfEmpty(string output)
    {
        string? empty = Directory.EnumerateFiles(Path.Combine(output, "wwwroot"), "*", SearchOption.AllDirectories)
            .FirstOrDefault(file => new FileInfo(file).Length == 0);
        if (empty is not null)
        {
            throw new InputException($"The page cannot be built: '{empty}' is empty.");
        }
    }

    /// <summary>Two processes that build in one folder would break each other's files.</summary>
    private static async Task<FileStream> LockAsync(string path, CancellationToken stop)
    {
        Directory.CreateDirectory(Path.GetDirectoryName(path)!);
        while (true)
        {
            try
            {
                return new FileStream(path, FileMode.OpenOrCreate, FileAccess.Write, FileShare.None);
            }
            catch (IOException)
            {
                await Task.Delay(Look, stop);
            }
        }
    }

    private static async Task PublishAsync(string project, string output, CancellationToken stop)
    {
        ProcessStartInfo how = new(Environment.GetEnvironmentVariable("DOTNET_HOST_PATH") ?? "dotnet")
        {
            ArgumentList = { "publish", project, "-c", "Release", "-o", output, "--nologo", "-v", "quiet", "-p:RunAnalyzers=false" },
            RedirectStandardOutput = true,
            RedirectStandardError = true,
            WorkingDirectory = Path.GetDirectoryName(project)!,
        };
        string[] inherited = [.. how.Environment.Keys.Where(name => name.StartsWith("MSBUILD", StringComparison.OrdinalIgnoreCase))];
        Array.ForEach(inherited, name => how.Environment.Remove(name)); // of the `dotnet run` that this may be in

        using Process build = Process.Start(how)!;
        Task<string> said = build.StandardOutput.ReadToEndAsync(stop), complained = build.StandardError.ReadToEndAsync(stop);
        try
        {
            await build.WaitForExitAsync(stop);
        }
        catch (OperationCanceledException)
        {
            build.Kill(entireProcessTree: true);
            throw;
        }

        if (build.ExitCode != 0)
        {
            string all = $"{await said}\n{await complained}";
            string[] lines = all.Split('\n', StringSplitOptions.RemoveEmptyEntries | StringSplitOptions.TrimEntries);
            string last = string.Join('\n', lines.TakeLast(LinesOfAFailure));
            throw new InputException($"The page cannot be built: dotnet publish ended with {build.ExitCode}.\n{last}");
        }
    }
}
