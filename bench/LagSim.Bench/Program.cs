using BenchmarkDotNet.Running;

namespace LagSim.Bench;

internal static class Program
{
    internal static void Main(string[] arguments) => BenchmarkSwitcher.FromAssembly(typeof(Program).Assembly).Run(arguments);
}
