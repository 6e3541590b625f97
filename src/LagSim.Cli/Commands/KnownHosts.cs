using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.IO;
using System.Linq;
using System.Threading;
using LagSim.Cli.Output;
using LagSim.Net.Protection;

namespace LagSim.Cli.Commands;

/// <summary>A file that remembers which host answered at an address: on each line an address and a fingerprint, as ssh's known_hosts.</summary>
/// <param name="file">The file, which need not exist yet.</param>
internal sealed class KnownHosts(string file)
{
    private static readonly TimeSpan LongestWait = TimeSpan.FromSeconds(5);

    /// <summary>The file in the user's folder for settings; null if the system has none.</summary>
    internal static string? UsualFile =>
        Environment.GetFolderPath(Environment.SpecialFolder.ApplicationData, Environment.SpecialFolderOption.DoNotVerify) is { Length: > 0 } folder
            ? Path.Combine(folder, "lagsim", "known_hosts") : null;

    /// <summary>The file.</summary>
    internal string File => file;

    /// <summary>The fingerprint of the host at an address, and its line, counted from 1; null if the address is not known.</summary>
    /// <exception cref="InputException">A line is none.</exception>
    /// <exception cref="IOException">The file cannot be read.</exception>
    internal (HostFingerprint Fingerprint, int Line)? Find(string address)
    {
        string[] lines = Lines();
        for (int n = 0; n < lines.Length; n++)
        {
            if (Read(lines[n], n + 1) is (string known, HostFingerprint fingerprint) && known == address)
            {
                return (fingerprint, n + 1);
            }
        }

        return null;
    }

    /// <summary>Remembers the host at an address, in place of any other there. What other programs add meanwhile stays.</summary>
    /// <exception cref="IOException">The file cannot be written.</exception>
    internal void Remember(string address, HostFingerprint fingerprint)
    {
        string target = SecretFile.TargetOf(file);
        try
        {
            Directory.CreateDirectory(Path.GetDirectoryName(Path.GetFullPath(target))!);
            using FileStream held = Held(target + ".lock");
            IEnumerable<string> others = Lines().Where((line, n) => Read(line, n + 1)?.Address != address);
            string[] lines = [.. others, $"{address} {fingerprint}"];
            SecretFile.Replace(file, draft => System.IO.File.WriteAllLines(draft, lines));
        }
        catch (Exception failure) when (failure is IOException { InnerException: null } or UnauthorizedAccessException)
        {
            throw new IOException($"'{file}' cannot be written. {WriteFailure.Cause(target, failure)}", failure);
        }
    }

    /// <summary>
    /// Opens a file that only one program can have open at a time, so that none writes over what another adds. It stays there, empty: who
    /// deleted it could delete one that another program holds.
    /// </summary>
    private static FileStream Held(string name)
    {
        for (Stopwatch waiting = Stopwatch.StartNew(); ;)
        {
            try
            {
                return new FileStream(name, FileMode.OpenOrCreate, FileAccess.ReadWrite, FileShare.None);
            }
            catch (IOException failure) when (IsOfAnother(failure) && waiting.Elapsed < LongestWait)
            {
                Thread.Sleep(10);
            }
            catch (IOException failure) when (IsOfAnother(failure))
            {
                throw new IOException($"Another program has held '{name}' for {LongestWait.TotalSeconds} s.", failure);
            }
        }
    }

    /// <summary>Whether a file could not be opened since another program has it: a sharing or lock violation, or EAGAIN on Linux or macOS.</summary>
    private static bool IsOfAnother(IOException failure) =>
        OperatingSystem.IsWindows() ? (failure.HResult & 0xFFFF) is 32 or 33 : failure.HResult is 11 or 35;

    private string[] Lines() => SecretFile.TargetOf(file) is string target && System.IO.File.Exists(target) ? System.IO.File.ReadAllLines(target) : [];

    private (string Address, HostFingerprint Fingerprint)? Read(string line, int number)
    {
        string[] words = line.Split(' ', StringSplitOptions.RemoveEmptyEntries | StringSplitOptions.TrimEntries);
        return words.Length == 0 || words[0][0] == '#' ? null
            : words is [string address, string text] && HostFingerprint.TryParse(text, out HostFingerprint fingerprint) ? (address, fingerprint)
            : throw new InputException(
                $"Line {number} of '{file}' is '{line}'; it must be an address, a blank, and a host's fingerprint of {HostFingerprint.TextLength} hexadecimal digits.");
    }
}
